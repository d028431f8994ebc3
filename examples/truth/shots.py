"""What is rendered of a skin: plain data, without Blender."""

from dataclasses import asdict, dataclass

TYPES = ("I", "II", "III", "IV", "V", "VI")


@dataclass(frozen=True)
class Tan:
    """Sun on day 0, in minimal melanogenesis doses, and the day on which the skin is seen.

    With `burns` the dose is in minimal erythema doses, skin reddens, and its melanin is as measured
    in people, not as in the thesis.
    """

    multiple: float
    day: float
    burns: bool = False


TANS = {
    "untanned": Tan(0.0, 0.0),
    "light": Tan(2.0, 7.0),
    "dark": Tan(8.0, 10.0),
    "faded": Tan(8.0, 30.0),
}

BURNS = {"burnt": Tan(2.0, 1.0, burns=True), "tanned by it": Tan(2.0, 10.0, burns=True)}

SUNNED = {**TANS, **BURNS}

BLOODS = (1.0, 3.0, 8.0)
"""Blood of both dermal layers, as multiples of the untanned skin's; what is added is arterial."""

DONE = "done "
"""How the line begins that Blender's process prints for each picture."""

LAST_DAY, FRAMES_PER_DAY = 30.0, 4


@dataclass(frozen=True)
class Shot:
    """One picture of a skin, flat on all stages but "ball".

    Attributes
    ----------
    name : str
    stage : str
        A key of `examples.truth.stages.STAGES`.
    skin : str
        One of the add-on's skins.
    tan : str
        One of `SUNNED`.
    table : str
        File of the skin's table in place of the add-on's own; empty for that.
    blood : float
        What the group's input Blood is set to.
    film : str
        What lies on the skin, as the add-on calls it.
    gloss : bool
        Whether the surface reflects; straight above, a lamp's reflection outshines the skin.
    angle : float
        In degrees from the normal: of the camera, or of the light on the stage "lobe".
    thickness : float
        Of a slab, in mm.
    size : tuple of int
        Columns and rows.
    samples, seed : int
        For each pixel, and of chance.
    plain : bool
        Whether a single Principled BSDF with subsurface stands in for the add-on's material.
    engine : str
        Blender's name of it.
    space : str
        Blender's working space; empty for its usual one.
    unit : float
        Length of a scene unit in metres.
    scale : float
        Scale of the object, whose mesh is so much smaller.
    model_scale : float
        How many times life-size all of the scene is; mended after Apply by one click.
    applied_unit : float
        `unit` at Apply, mended by one click afterwards; 0 where it was the same.
    configuration : str
        A file of OpenColorIO's in this folder; empty for Blender's own.
    """

    name: str
    stage: str
    skin: str
    tan: str = "untanned"
    blood: float = 1.0
    angle: float = 0.0
    thickness: float = 0.0
    size: tuple[int, int] = (32, 32)
    samples: int = 256
    seed: int = 1
    table: str = ""
    plain: bool = False
    engine: str = "CYCLES"
    space: str = ""
    unit: float = 1.0
    scale: float = 1.0
    film: str = "NONE"
    gloss: bool = True
    model_scale: float = 1.0
    applied_unit: float = 0.0
    configuration: str = ""

    @property
    def described(self) -> dict:
        """The shot as what JSON holds; `of` reads it."""
        return asdict(self)

    @classmethod
    def of(cls, described: dict) -> "Shot":
        """The shot that `described` describes."""
        return cls(**{**described, "size": tuple(described["size"])})
