"""All that an artist sets on one object."""

from contextlib import suppress
from dataclasses import replace
from math import isclose
from pathlib import Path
from typing import Any, cast

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from hylios.errors import InputError

from ..model.catalogue import provenance
from ..model.settings import (
    FRAME_LIMIT,
    LARGEST_MINIMAL_DOSE,
    LARGEST_SCALE,
    LAST_DAY_LIMIT,
    LEAST_MINIMAL_DOSE,
    LEAST_SCALE,
    Exposure,
    MinimalDoses,
    TanSettings,
    minimal_doses,
    own_minimal_doses,
)
from ..model.timing import FRAMES, LARGEST_SPEED, LEAST_SPEED, SCENE, Timing
from ..scene.masks import Mask
from .biology import SkinTanBiology
from .choices import FILMS, TIMINGS
from .exposure import SkinTanExposure
from .mask import SkinTanFilmMask, SkinTanMask, follow_image, take_attribute, usable_names
from .material import SkinTanMaterial
from .region import SkinTanRegion, is_shown
from .response import (
    KINETICS,
    NAMES,
    keep_kinetics,
    keep_redness,
    kept_property,
    kinetics_of,
    redness_of,
)
from .skins import SKIN_ITEMS, USUAL_SKIN, table_file


def _set_two_frames(settings: "SkinTanSettings", _: bpy.types.Context) -> None:
    """Frames that a script sets count, as they did before there was a choice."""
    if settings.timing == SCENE:
        settings.timing = FRAMES


def _start_at_skin(settings: "SkinTanSettings", _: bpy.types.Context) -> None:
    """Doses that nobody has set start at those of the skin, and go with it."""
    with suppress(InputError):
        told = minimal_doses(provenance(settings.table_file()))
        for name in ("mmd", "med"):
            own = getattr(told, name)
            if settings.own_minimal_doses:
                if not settings.is_property_set(name):
                    setattr(settings, name, own)
            elif isclose(getattr(settings, name), own, rel_tol=1e-5):
                settings.property_unset(name)


def settings_of(obj: bpy.types.Object) -> "SkinTanSettings":
    """What is set on an object."""
    return cast(Any, obj).skin_tan


class SkinTanSettings(bpy.types.PropertyGroup):
    skin: EnumProperty(
        name="Skin",
        description="Whose skin it is: a skin type from I (very light) to VI (dark), a skin of the "
        "thesis, or a table of your own",
        items=SKIN_ITEMS,
        default=USUAL_SKIN,
    )
    table_path: StringProperty(
        name="Table",
        description="File of a skin table (EXR), as lut-builder makes it",
        subtype="FILE_PATH",
        options={"PATH_SUPPORTS_BLEND_RELATIVE"},
    )
    biology: PointerProperty(
        name="Biology",
        description="What differs in this skin from its type",
        type=SkinTanBiology,
    )
    own_minimal_doses: BoolProperty(
        name="Set Sensitivity by Hand",
        description="Set how much sun this person needs to tan and to burn, in SED, in place of "
        "the skin's own",
        update=_start_at_skin,
    )
    mmd: FloatProperty(
        name="Tans from (SED)",
        description="Smallest dose in SED that tans this skin (MMD). Less: it tans more",
        default=7.0,
        min=LEAST_MINIMAL_DOSE,
        soft_max=60.0,
        max=LARGEST_MINIMAL_DOSE,
        step=10,
        precision=1,
    )
    med: FloatProperty(
        name="Burns from (SED)",
        description="Smallest dose in SED that reddens this skin (MED). Less: it burns more",
        default=4.0,
        min=LEAST_MINIMAL_DOSE,
        soft_max=60.0,
        max=LARGEST_MINIMAL_DOSE,
        step=10,
        precision=1,
    )
    kinetics: EnumProperty(
        name="Tan",
        description="How a tan comes and goes over the days",
        items=KINETICS,
        get=kinetics_of,
        set=keep_kinetics,
    )
    kinetics_kept: kept_property("Tan, Kept", len(NAMES) - 1)
    redness: BoolProperty(
        name="Sunburn",
        description="Skin reddens for hours to days after much sun. An estimate, fitted to what "
        "was measured in people",
        get=redness_of,
        set=keep_redness,
    )
    redness_kept: kept_property("Sunburn, Kept", 1)
    peeling: BoolProperty(
        name="Peeling",
        description="Skin that got 3 burn doses or more peels in patches 4 to 8 days later. It "
        "loses most of its tan there (dark skin little) and regains it over weeks. An estimate",
    )
    darkening: BoolProperty(
        name="UVA Darkening",
        description="Skin darkens while it is in the sun and pales over two days, before the tan "
        "comes. For times given as Sun; seen where frames are hours apart, not days. An estimate",
    )
    model_scale: FloatProperty(
        name="Model Scale",
        description="How many times life-size the model is: 10 for a body 17 m tall. Light "
        "travels so much farther in its skin, and its pores are so much larger",
        default=1.0,
        min=LEAST_SCALE,
        max=LARGEST_SCALE,
        soft_min=0.01,
        soft_max=100.0,
        step=10,
        precision=3,
    )
    group: PointerProperty(
        name="Node Group",
        description="The node group that Apply made for this object",
        type=bpy.types.NodeTree,
        options={"HIDDEN"},
    )
    material: PointerProperty(
        name="Material",
        description="The material that Apply made for this object, which had none",
        type=bpy.types.Material,
        options={"HIDDEN"},
    )
    materials: CollectionProperty(type=SkinTanMaterial)
    new_material: BoolProperty(
        name="New Material",
        description="Put a new skin in place of the ticked materials that have no tan yet. Remove "
        "Tan gives them back",
    )
    own_colour: BoolProperty(
        name="Tan from Own Colour",
        description="Painted freckles, moles and other darker, lighter or redder places tan as "
        "such skin does. Without it, all skin tans alike. No effect on a new material",
    )
    usual_colour: FloatVectorProperty(
        name="Usual Colour",
        description="The colour in which most of the skin is painted; it tans as the skin type "
        "does. Black: Apply Tan takes it from the texture",
        subtype="COLOR",
        min=0.0,
        max=1.0,
    )
    exposures: CollectionProperty(type=SkinTanExposure)
    exposure_index: IntProperty(name="Active Time in the Sun", options={"HIDDEN"})
    film: EnumProperty(
        name="Film",
        description="What lies on the skin: it shines, and fills the pores. It does not protect",
        items=FILMS,
        default="NONE",
    )
    film_mask: PointerProperty(
        name="Film Mask",
        description="Where the film lies; without a mask it lies everywhere",
        type=SkinTanFilmMask,
    )
    regions: CollectionProperty(type=SkinTanRegion)
    region_index: IntProperty(name="Active Region", options={"HIDDEN"})
    mask: PointerProperty(
        name="Mask",
        description="Where the sun reaches, for all times in the sun without their own mask",
        type=SkinTanMask,
    )
    mask_attribute: StringProperty(
        name="Mask",
        description="What says how much of the sun reaches each point: 0 is covered, 1 is bare",
        search=usable_names,
        update=take_attribute,
    )
    """The mask's source, as scripts and files of version 0.1.0 set it."""
    first_day: FloatProperty(
        name="First Day",
        description="When the first frame is, in days from the start of the tan",
        min=0.0,
        max=LAST_DAY_LIMIT,
        step=100,
        precision=1,
    )
    last_day: FloatProperty(
        name="Last Day",
        description="When the last frame is, in days from the start of the tan",
        default=30.0,
        min=0.0,
        max=LAST_DAY_LIMIT,
        step=100,
        precision=1,
    )
    timing: EnumProperty(
        name="Timing",
        description="How the days lie on the timeline",
        items=TIMINGS,
        default=SCENE,
    )
    first_frame: IntProperty(
        name="First Frame",
        description="Frame that shows the first day",
        default=1,
        min=-FRAME_LIMIT,
        max=FRAME_LIMIT,
        update=_set_two_frames,
    )
    last_frame: IntProperty(
        name="Last Frame",
        description="Frame that shows the last day",
        default=250,
        min=-FRAME_LIMIT,
        max=FRAME_LIMIT,
        update=_set_two_frames,
    )
    days_per_second: FloatProperty(
        name="Days per Second",
        description="How many days pass in a second of animation",
        default=3.0,
        min=LEAST_SPEED,
        soft_min=0.1,
        soft_max=30.0,
        max=LARGEST_SPEED,
        step=10,
        precision=1,
    )
    keyed: FloatVectorProperty(
        name="Keyed",
        description="First and last day and their frames, as Apply keyed them last",
        size=4,
        options={"HIDDEN"},
    )
    own_day: StringProperty(name="Own Day", description="Your own tan_day", options={"HIDDEN"})
    applied: StringProperty(
        name="Applied",
        description="The settings that the tan shows, as Apply noted them",
        options={"HIDDEN"},
    )
    undone: StringProperty(
        name="Undone",
        description="Settings to which an undo led back, and which wait for Apply",
        options={"HIDDEN"},
    )
    live: BoolProperty(
        name="Live",
        description="Show every change at once. Without it, changes wait for Apply Tan",
        default=True,
    )

    def values(self) -> TanSettings:
        """The settings as plain values.

        Raises
        ------
        InputError
            If no table is set, or a value is out of range.
        """
        return TanSettings(
            table=self.table_file(),
            own_doses=self.own_doses(),
            exposures=tuple(Exposure.of(item) for item in self.exposures if item.enabled),
            first_day=self.first_day,
            last_day=self.last_day,
            biology=self.biology.values(),
            kinetics=self.kinetics.lower(),
            redness=self.redness,
            peeling=self.peeling,
            darkening=self.darkening,
        )

    def response_numbers(self) -> dict[str, int]:
        """What `kinetics_kept` and `redness_kept` are of a tan that shows the settings."""
        return {"kinetics_kept": kinetics_of(self), "redness_kept": int(redness_of(self))}

    def timing_values(self) -> Timing:
        """What is set on the timeline."""
        way = self.timing
        two_frames = (
            self.is_property_set("first_frame")
            or self.is_property_set("last_frame")
            or (self.group is not None and not self.is_property_set("keyed"))
        )
        if two_frames and not self.is_property_set("timing"):
            way = FRAMES  # a file from before there was a choice
        return Timing(way, self.first_frame, self.last_frame, self.days_per_second)

    def object_mask(self) -> Mask:
        """The mask of all exposures that have none of their own."""
        mask = Mask.of(self.mask)
        return mask or replace(mask, source=self.mask_attribute)

    def worn_film_mask(self) -> Mask:
        """Where the film lies; no mask where there is no film."""
        return Mask() if self.film == "NONE" else Mask.of(self.film_mask)

    def shown_regions(self) -> list[SkinTanRegion]:
        """The regions that change anything, in their order."""
        return [region for region in self.regions if is_shown(region)]

    def name_masks(self) -> None:
        """Call masks by their images' names, which may have been renamed."""
        owners = (*self.exposures, *self.regions)
        for mask in (self.mask, self.film_mask, *(owner.mask for owner in owners)):
            follow_image(mask)

    def masks(self) -> tuple[Mask, ...]:
        """The masks of the exposures that count, in their order."""
        return tuple(
            Mask.of(exposure.mask) if exposure.own_mask else self.object_mask()
            for exposure in self.exposures
            if exposure.enabled
        )

    def all_masks(self) -> set[Mask]:
        """Those of all that shows: the sun, the film and the regions."""
        of_regions = (Mask.of(region.mask) for region in self.shown_regions())
        return {*self.masks(), self.shown_mask(), self.worn_film_mask(), *of_regions}

    def shown_mask(self) -> Mask:
        """The one mask of all exposures; where they have several, the object's."""
        masks = set(self.masks())
        return masks.pop() if len(masks) == 1 else self.object_mask()

    def table_file(self) -> Path:
        """Path of the skin's table.

        Raises
        ------
        InputError
            If none is set, if its file is not there, or if this add-on lacks the skin.
        """
        return table_file(self.skin, self.table_path)

    def own_doses(self) -> MinimalDoses | None:
        """Minimal doses where they are set by hand.

        Raises
        ------
        InputError
            If one is out of range.
        """
        if not self.own_minimal_doses:
            return None
        return own_minimal_doses(self.mmd, self.med)
