"""What values a parameter of skin takes in living people, and where that is known from.

The ranges hold for thin skin (all but palms and soles) of people who are well or have a condition
that shows in the skin: no melanin at all (vitiligo) is within them, and so are smokers' blood and
jaundice of the newborn. A number without a measurement behind it is marked ESTIMATE. "Thesis" is
T. F. Chen's; its numbers in brackets are those of its bibliography.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType


@dataclass(frozen=True)
class Physiology:
    """The physiological range of a parameter, in the parameter's unit.

    Attributes
    ----------
    low, high : float
        Both ends belong to the range.
    source : str
        Where the range comes from, with ESTIMATE where it is one.
    cited : str
        What the thesis cites for its own values, in table 6.1 or 6.2.
    """

    low: float
    high: float
    source: str
    cited: str

    def holds(self, value: float) -> bool:
        """Whether a value lies within the range."""
        return self.low <= value <= self.high


MOST_EPIDERMAL_MELANIN = 0.43
"""Volume fraction of melanin in the whole epidermis of the darkest skin (thesis, section 3.4)."""

_MELANIN = (
    "thesis: none in vitiligo (appendix D.1), up to 45 % in one layer (S4's colloidal case of "
    "appendix C); the mean of the epidermis, both forms, is held to 43 % (section 3.4)"
)
_EPIDERMAL_LAYER = (
    "ESTIMATE around a third of the living epidermis, 19 to 27 um in the mean by site "
    "(Sandby-Moller et al., Acta Derm Venereol 83:410, 2003); the thesis's S4 has 7 um"
)
_BLOOD = (
    "0.08 % in a forearm at rest (Fredriksson et al., J Biomed Opt 13:014015, 2008) to 4 %, as in "
    "erythema (phantoms of Pravdin et al., Proc SPIE 2627, 1995); thesis, appendix D.1: 0.225 to "
    "3.12 %"
)
_CAROTENE = (
    "ESTIMATE from 13 ug per g of protein, SD 5, in the back's epidermis (Vahlquist et al., J "
    "Invest Dermatol 79:94, 1982): up to two SD more, at 0.3 g of protein per mL"
)
_WATER = (
    "thesis: 40 % less than table 6.2 is within physiological limits (figure 6.11), and 25 % more "
    "(appendix D.1, whose ends are 0.75 of the stratum corneum's and 1.25 of the dermis's)"
)
_LIPIDS = (
    "ESTIMATE: thesis, appendix D.1, has 11.32 (0.75 of the papillary dermis's) to 0.25 %, and "
    "1.25 of table 6.2 if its other ranges are a guide"
)
_DERMAL_INDEX = (
    "1.36 at 1310 nm (Ding et al., Phys Med Biol 51:1479, 2006), 1.39 and 1.41 in table 6.2; the "
    "ends are an ESTIMATE: water has 1.32"
)

_RANGES = {
    "surface_fold_aspect_ratio": Physiology(
        0.0, 1.0, "ESTIMATE: from flat to twice S4's, rounded up", "[114, 182]"
    ),
    "corneum_thickness": Physiology(
        3e-4,
        3.6e-3,
        "thesis, appendix A, 3 to 36 um; a palm's 173 um (Acta Derm Venereol 87:4, 2007) is thick "
        "skin",
        "[7, 49]",
    ),
    "granulosum_thickness": Physiology(5e-4, 5e-3, _EPIDERMAL_LAYER, "[162]"),
    "spinosum_thickness": Physiology(
        5e-4,
        1.13e-2,
        "below, ESTIMATE; above, the living epidermis of the buttock plus two SD (Sandby-Moller "
        "et al., Acta Derm Venereol 83:410, 2003)",
        "[162]",
    ),
    "basale_thickness": Physiology(5e-4, 5e-3, _EPIDERMAL_LAYER, "[170]"),
    "papillary_thickness": Physiology(
        5e-3, 4e-2, "ESTIMATE: half to twice what table 6.1 has", "[6]"
    ),
    "reticular_thickness": Physiology(
        2e-2,
        0.4,
        "below, an eyelid's (ESTIMATE); above, the whole dermis's 4 mm (thesis, chapter 3)",
        "[6]",
    ),
    **dict.fromkeys(
        ("granulosum_melanosomes", "spinosum_melanosomes", "basale_melanosomes"),
        Physiology(0.0, 45.0, _MELANIN, "[103, 110]"),
    ),
    **dict.fromkeys(
        (
            "granulosum_colloidal_melanin",
            "spinosum_colloidal_melanin",
            "basale_colloidal_melanin",
        ),
        Physiology(0.0, 45.0, _MELANIN, "[3, 103, 143]"),
    ),
    "eumelanin_concentration": Physiology(
        10.0,
        100.0,
        "thesis: 24 to 62.5 (appendix D.1), 90 in S1; tenfold variation is to be expected "
        "(Jacques, Melanosome absorption coefficient, omlc.org, 1998); the ends are an ESTIMATE",
        "[82, 186]",
    ),
    "pheomelanin_concentration": Physiology(
        1.5,
        35.0,
        "below, thesis, appendix D.1; above, 26 % of all melanin (Del Bino et al., Pigment Cell "
        "Melanoma Res 28:707, 2015) beside 100 mg/mL of eumelanin",
        "[82, 186]",
    ),
    "melanosome_major_axis": Physiology(
        0.2, 1.2, "thesis, section 6.1.1: 0.4 to 0.69 um; the ends are an ESTIMATE", "[136]"
    ),
    "melanosome_minor_axis": Physiology(
        0.1, 0.6, "thesis, section 6.1.1: 0.17 to 0.28 um; the ends are an ESTIMATE", "[136]"
    ),
    "papillary_blood": Physiology(0.08, 4.0, _BLOOD, "[56, 90]"),
    "reticular_blood": Physiology(0.08, 4.0, _BLOOD, "[56, 90]"),
    "oxygenated_blood": Physiology(
        25.0,
        100.0,
        "26 % in a finger cut off from its blood (Marcinkevics et al., Proc SPIE 10685, 2018), to "
        "arterial blood; 52 to 92 % by site at rest (Int J Microcirc 15:131, 1995)",
        "[8]",
    ),
    "corneum_refractive_index": Physiology(
        1.45,
        1.56,
        "1.51 to 1.53 in cheeks at 550 nm (Yoshida et al., J Biomed Opt 18:037002, 2013); the "
        "ends are an ESTIMATE",
        "[48, 183]",
    ),
    "epidermis_refractive_index": Physiology(
        1.33,
        1.45,
        "1.42 at 1310 nm (Ding et al., Phys Med Biol 51:1479, 2006); the ends are an ESTIMATE: "
        "water has 1.32",
        "[183, 191]",
    ),
    "papillary_refractive_index": Physiology(1.33, 1.45, _DERMAL_INDEX, "[92, 183]"),
    "reticular_refractive_index": Physiology(1.33, 1.45, _DERMAL_INDEX, "[92, 183]"),
    "melanin_refractive_index": Physiology(1.6, 1.8, "ESTIMATE", "[20]"),
    "hemoglobin": Physiology(
        55.0,
        190.0,
        "measured at high altitude, with and without anaemia (BMC Public Health 9:336, 2009)",
        "[56, 113]",
    ),
    "methemoglobin": Physiology(
        0.0,
        30.0,
        "20 % of 150 mg/mL: above, there are symptoms other than the skin's colour (Abouelezz, "
        "Medscape, Methemoglobinemia, 2023); usual is up to 3 %",
        "[81]",
    ),
    "carboxyhemoglobin": Physiology(
        0.0,
        22.5,
        "15 % of 150 mg/mL: smokers (Carboxyhemoglobin Results, Case Studies, weber.edu); usual "
        "is up to 3 %",
        "[43]",
    ),
    "sulfhemoglobin": Physiology(
        0.0,
        5.0,
        "usually none; cyanosis begins at 0.5 g/dL (mdnxs.com, Cyanosis); that this is the limit "
        "is an ESTIMATE",
        "[209]",
    ),
    "blood_bilirubin": Physiology(
        0.0,
        0.09,
        "healthy newborns: 17 mg/dL of serum (Porter and Dennis, Am Fam Physician 65:599, 2002), "
        "which is 55 % of blood (ESTIMATE)",
        "[213]",
    ),
    "corneum_beta_carotene": Physiology(0.0, 7e-3, _CAROTENE, "[109]"),
    "epidermis_beta_carotene": Physiology(0.0, 7e-3, _CAROTENE, "[109]"),
    "blood_beta_carotene": Physiology(
        0.0,
        2.8e-3,
        "carotenaemia: 500 ug/dL of serum (Schwartz, Medscape, Carotenemia, 2021), which is 55 % "
        "of blood (ESTIMATE)",
        "[109]",
    ),
    "corneum_water": Physiology(
        12.0,
        75.0,
        "15 % of the dry weight to 75 % when soaked (Washington et al., Physiological "
        "Pharmaceutics, chapter on skin); by volume an ESTIMATE",
        "[2, 125]",
    ),
    "epidermis_water": Physiology(36.0, 75.0, _WATER, "[2, 197]"),
    "papillary_water": Physiology(45.0, 93.75, _WATER, "[2, 197]"),
    "reticular_water": Physiology(45.0, 93.75, _WATER, "[2, 197]"),
    "corneum_lipids": Physiology(
        5.0,
        45.0,
        "ESTIMATE, around 20 % (Walters and Roberts, 2002, as a review quotes them) and 1.25 of "
        "table 6.2",
        "[203]",
    ),
    "epidermis_lipids": Physiology(0.25, 25.0, _LIPIDS, "[2, 31, 174]"),
    "papillary_lipids": Physiology(0.25, 25.0, _LIPIDS, "[2, 31, 174]"),
    "reticular_lipids": Physiology(0.25, 25.0, _LIPIDS, "[2, 31, 174]"),
    "corneum_keratin": Physiology(
        50.0,
        80.0,
        "ESTIMATE, around 60 % (Imae, Response to External Stimulation on Skin) and 70 % "
        "(Walters and Roberts, 2002, as a review quotes them)",
        "[60, 64, 170]",
    ),
    "corneum_urocanic_acid": Physiology(0.0029, 0.0287, "thesis, appendix A", "[211]"),
    "hypodermis_reflectance": Physiology(
        40.0,
        100.0,
        "above, the thesis (section 4.3), which lets it reflect everything; below, ESTIMATE: fat "
        "ex vivo at 800 and 900 nm, K = 2 mu_a and S = 3/4 mu_s' of Kubelka and Munk, 59 % by both "
        "Bashkatov et al. (J Innov Opt Health Sci 4:9, 2011) and Simpson et al. (Phys Med Biol "
        "43:2465, 1998), 44 % by the latter at 633 nm",
        "[208]",
    ),
    "skin_dna": Physiology(
        0.1,
        10.0,
        "ESTIMATE, from half the mean over the whole skin to 6.4 pg (thesis, appendix A) in every "
        "640 um3 of epidermis",
        "[2, 57, 196]",
    ),
}

PHYSIOLOGY: Mapping[str, Physiology] = MappingProxyType(_RANGES)
"""The physiological range of every numeric parameter of `hylios.skin.specimen.Specimen` by name."""
