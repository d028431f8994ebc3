"""The add-on in other languages, by Blender's own translations."""

from typing import Any, cast

import bpy

from .model.lines import Line

GERMAN = {
    # buttons
    "Apply Tan": "Bräune anwenden",
    "Remove Tan": "Bräune entfernen",
    "Copy Tan to Selected": "Bräune auf Auswahl kopieren",
    "Find Skin Materials": "Hautmaterialien suchen",
    "Paint Mask": "Maske malen",
    "From Clothes": "Aus Kleidung",
    "Match Colour": "Nach Farbe",
    "Match Painted Skin": "Nach gemalter Haut",
    "Choose Skin Type": "Hauttyp wählen",
    "Reset Biology": "Biologie zurücksetzen",
    "Copy Build Command": "Baubefehl kopieren",
    "Add Time in the Sun": "Zeit in der Sonne hinzufügen",
    "Add Region": "Region hinzufügen",
    "Remove Region": "Region entfernen",
    "Duplicate Time in the Sun": "Zeit in der Sonne duplizieren",
    "Move Time in the Sun": "Zeit in der Sonne verschieben",
    "Remove Time in the Sun": "Zeit in der Sonne entfernen",
    "Import CSV": "CSV importieren",
    "Export CSV": "CSV exportieren",
    "Import Weather": "Wetter importieren",
    "Export for lut-builder": "Für lut-builder exportieren",
    "Fit Skin to Size": "Haut an Größe anpassen",
    "Darkest Day": "Dunkelster Tag",
    "Reset Timing": "Zeiten zurücksetzen",
    # panels
    "Skin Tan": "Hautbräune",
    "Skin": "Haut",
    "Biology": "Biologie",
    "Regions": "Regionen",
    "Time in the Sun": "Zeit in der Sonne",
    "Times in the Sun": "Zeiten in der Sonne",
    "Where the Sun Reaches": "Wohin die Sonne kommt",
    "Timeline": "Zeitleiste",
    "Materials That Tan": "Bräunende Materialien",
    "On the Skin": "Auf der Haut",
    "View of All Skin": "Ansicht aller Haut",
    "Skin Presets": "Hautvorlagen",
    "Schedule Presets": "Zeitplanvorlagen",
    # the skin
    "Type I, very light": "Typ I, sehr hell",
    "Type II, light": "Typ II, hell",
    "Type III, intermediate": "Typ III, mittel",
    "Type IV, tan": "Typ IV, oliv",
    "Type V, brown": "Typ V, braun",
    "Type VI, dark": "Typ VI, dunkel",
    "Table File": "Tabellendatei",
    "Tan from Own Colour": "Bräune nach eigener Farbe",
    "Usual Colour": "Übliche Farbe",
    "As Measured in People": "Wie an Menschen gemessen",
    "As in the Thesis": "Wie in der Dissertation",
    "Sunburn": "Sonnenbrand",
    "Peeling": "Hautschälung",
    "UVA Darkening": "UVA-Dunkelung",
    "Set Sensitivity by Hand": "Empfindlichkeit selbst setzen",
    "Tans from (SED)": "Bräunt ab (SED)",
    "Burns from (SED)": "Rötet ab (SED)",
    "Melanin": "Melanin",
    "Eumelanin": "Eumelanin",
    "Pheomelanin": "Phäomelanin",
    "Blood": "Blut",
    "Oxygen": "Sauerstoff",
    "Thickness": "Dicke",
    # regions
    "Freckles": "Sommersprossen",
    "Age Spots": "Altersflecken",
    "Moles": "Muttermale",
    "Cheeks": "Wangen",
    "Forehead": "Stirn",
    "Ears": "Ohren",
    "Fingers": "Finger",
    "Palms and Soles": "Handflächen und Sohlen",
    "Lips": "Lippen",
    "Flush": "Gerötete Haut",
    "Vitiligo": "Vitiligo",
    "Painted Spots": "Gemalte Flecken",
    "No mask: they are everywhere": "Keine Maske: überall",
    "No mask: it is nowhere": "Keine Maske: nirgends",
    # exposures
    "Given as": "Angabe",
    "Dose": "Dosis",
    "Dose (SED)": "Dosis (SED)",
    "Tanning Doses": "Bräunungsdosen",
    "UV Index": "UV-Index",
    "Sun": "Sonne",
    "Hours": "Stunden",
    "Day": "Tag",
    "Month": "Monat",
    "Day of Month": "Tag im Monat",
    "Latitude (°)": "Breite (°)",
    "Altitude (m)": "Höhe (m)",
    "Clouds": "Wolken",
    "Ground": "Boden",
    "Usual": "Üblich",
    "Grass": "Gras",
    "Sand": "Sand",
    "Foam": "Gischt",
    "Snow": "Schnee",
    "Through": "Durch",
    "Air": "Luft",
    "Window": "Fenster",
    "Car Window": "Autofenster",
    "Windscreen": "Windschutz",
    "Depth (m)": "Tiefe (m)",
    "From (h)": "Von (h)",
    "To (h)": "Bis (h)",
    "Sunscreen": "Sonnencreme",
    "SPF": "LSF",
    "Own Mask": "Eigene Maske",
    # masks and films
    "Mask": "Maske",
    "Channel": "Kanal",
    "Strength": "Stärke",
    "Invert": "Umkehren",
    "Brightness": "Helligkeit",
    "Film": "Film",
    "Dry": "Trocken",
    "Water": "Wasser",
    "Oil": "Öl",
    # the timeline, materials and views
    "Live": "Live",
    "Scene's Frames": "Bilder der Szene",
    "Start and Speed": "Beginn und Tempo",
    "Two Frames": "Zwei Bilder",
    "Own Keys": "Eigene Keyframes",
    "First Day": "Erster Tag",
    "Last Day": "Letzter Tag",
    "at Frame": "bei Bild",
    "Days per Second": "Tage pro Sekunde",
    "Reset": "Zurücksetzen",
    "New Material": "Neues Material",
    "Model Scale": "Maßstab",
    "Visible": "Sichtbar",
    # lines
    "This frame shows day {day:.1f}": "Dieses Bild zeigt Tag {day:.1f}",
    "Day {day:g}": "Tag {day:g}",
    "Select a mesh object": "Ein Mesh-Objekt auswählen",
    "Changed: Apply Tan shows it": "Geändert: bitte anwenden",
    "Scene's frames have changed:": "Bilder der Szene sind anders:",
    "Apply Tan follows them": "Anwenden richtet sich danach",
    "Add a time in the sun with +": "Mit + eine Zeit hinzufügen",
    "Tans from {mmd:.1f} SED of sun,": "Bräunt ab {mmd:.1f} SED Sonne,",
    "burns from {med:.1f} SED (estimates)": "rötet ab {med:.1f} SED (geschätzt)",
    "{dose:g} SED": "{dose:g} SED",
    "{multiple:g} tanning doses": "{multiple:g} Bräunungsdosen",
    "UV {index:g}, {hours:g} h": "UV {index:g}, {hours:g} h",
    "Sun {start:g}-{end:g} h": "Sonne {start:g}-{end:g} h",
    "{meter:.3g} SED: {hours:.1f} h of strong sun": "{meter:.3g} SED: {hours:.1f} h starke Sonne",
    "{meter:.3g} SED: {minutes:.0f} min of strong sun": (
        "{meter:.3g} SED: {minutes:.0f} min starke Sonne"
    ),
    "tans like {tanning:.3g} SED": "bräunt wie {tanning:.3g} SED",
    "No time is given as Sun:": "Keine Zeit als Sonne angegeben:",
    "its UVA is not known": "ihr UVA ist unbekannt",
    "Orange: lightness, red: redness": "Orange: Helligkeit, rot: Röte",
    "Upright lines: days": "Senkrechte Linien: Tage",
    "Upright lines: weeks": "Senkrechte Linien: Wochen",
    "Upright lines: 4 weeks": "Senkrechte Linien: 4 Wochen",
    "Linked from another file: make it": "Aus anderer Datei verknüpft: lokal",
    "local or a library override": "machen oder überschreiben",
    "Library override: its tan changes in": "Überschreibung: Bräune ändert sich in",
    "its own file; Reset keys its days here": "ihrer Datei, Tage hier: Zurücksetzen",
    "Its mesh or animation is linked:": "Mesh oder Animation ist verknüpft:",
    "make it local to change its tan": "für die Bräune lokal machen",
    "Apply Tan cannot show it:": "Anwenden geht nicht:",
    "No tan that can be seen": "Keine sichtbare Bräune",
    "Darkest on day {darkest:.0f},": "Am dunkelsten an Tag {darkest:.0f},",
    "gone by day {gone:.0f}": "weg bis Tag {gone:.0f}",
    "Peels on days {first:.0f}-{last:.0f}": "Schält sich an Tag {first:.0f}-{last:.0f}",
    "Burns too little to peel": "Brennt zu wenig zum Schälen",
    "Burnt on day {day:.0f}": "Verbrannt an Tag {day:.0f}",
    "Burnt on days {first:.0f}-{last:.0f}": "Verbrannt an Tag {first:.0f}-{last:.0f}",
    "Burnt on days {first:.0f}-{until:.0f}, {again:.0f}-{last:.0f}": (
        "Verbrannt Tag {first:.0f}-{until:.0f}, {again:.0f}-{last:.0f}"
    ),
    "Burnt {count} times, days {first:.0f}-{last:.0f}": (
        "{count} mal verbrannt, Tag {first:.0f}-{last:.0f}"
    ),
    "Above 4 burn doses on day {day:.0f}:": "Über 4 Rötungsdosen an Tag {day:.0f}:",
    "blisters in life; not shown": "im Leben Blasen; nicht gezeigt",
    "not half gone by day {last:.0f}": "an Tag {last:.0f} nicht halb fort",
    "half gone by day {half:.0f}": "halb fort an Tag {half:.0f}",
    "half gone by day {half:.0f}, all by {gone:.0f}": "halb fort: Tag {half:.0f}, ganz: {gone:.0f}",
    "No mask: the whole body is bare": "Keine Maske: alles ist bloß",
    "No mask: it lies everywhere": "Keine Maske: liegt überall",
    "The mesh does not have this mask:": "Dem Mesh fehlt diese Maske:",
    "Choose a mask": "Maske wählen",
    "choose another one": "eine andere wählen",
    "No material: a new skin is made": "Kein Material: neue Haut",
    "Remove Tan to change this": "Erst die Bräune entfernen",
    "Light spreads as in the type.": "Licht läuft wie im Hauttyp.",
    "For a table of this very skin:": "Für eine Tabelle dieser Haut:",
    "A recoloured material": "Ein umgefärbtes Material",
    "shows no film, a new one does": "zeigt keinen, ein neues schon",
    "After the last day: no effect": "Nach dem letzten Tag: ohne Wirkung",
}
"""German by English. What Blender itself translates need not be here."""

CONTEXTS = ("*", "Operator")
"""Blender looks for the words of buttons in a context of their own."""

DICTIONARY = {
    "de_DE": {(context, text): told for text, told in GERMAN.items() for context in CONTEXTS}
}


def told(text: str) -> str:
    """A line in the language of the interface. Blender itself translates what has no values."""
    if not isinstance(text, Line):
        return text
    message: Any = bpy.app.translations.pgettext_iface(text.message)
    return message.format(**text.values)


def register() -> None:
    bpy.app.translations.register(__name__, cast(Any, DICTIONARY))


def unregister() -> None:
    bpy.app.translations.unregister(__name__)
