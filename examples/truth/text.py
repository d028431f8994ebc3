"""What the page says around its figures."""

INTRODUCTION = """\
# What Cycles shows, and what the model says

`make truth` renders flat pieces of skin as the add-on makes them and compares what Cycles shows
with the light model, which it asks directly: not the tables. The tans come by the add-on's own way,
exposures, Apply, `tan_day` keyed, a frame set. `make truth` renders again and writes this page;
`make truth ONLY=edge` compares one thing alone and writes into `out/truth`.

Distances are CIEDE2000 unless another unit stands there, white being a white diffuser in the same
light. Two numbers are the mean and the largest over the cases.
"""

MADE = """\
Made with {made}.

The types are I to VI; tans are untanned, light (2 minimal melanogenesis doses on day 0, seen on day
7), dark (8 doses, day 10) and faded (8 doses, day 30); blood is 1, 3 and 8 times the untanned
skin's in both dermal layers, what is added being arterial (an ESTIMATE, `hylios/skin/skin.py`).
"""

ALBEDO = """\
## Albedo

Skin of a metre, far more than light travels in it, under even white light from everywhere, seen by
a camera without perspective. By reciprocity it sees the directional-hemispherical reflectance at
its angle, which the model gives without noise (`hylios.adding`, 16 wavelengths). The model itself
is reciprocal but for two of its rules (`hylios/transport/angular.py`). The part that was inside is
read from Cycles' diffuse passes of the same picture.

```{image} truth_albedo.png
:alt: Patches of six types in four tans and three bloods; inside each the colour of the model.
:width: 100%
```

**Gloss at an angle.** Cycles lets facets of a rough surface shadow each other (GGX with Smith's
shadowing), the model draws the normal of a facet whatever of it the light sees, so that its surface
reflects more: .179 against .157 at 70 degrees, .349 against .266 at 80. The shader's gloss has a
factor by the angle of view (Specular Tint), at which its directional albedo is the model's; the
model says that without noise, and Cycles' own was measured (`examples/truth/layer.py`). What enters
is what is left: Principled BSDF keeps both at 1 in all.

**What is left of the light from inside** at 0 and 45 degrees is .1 at most. In light types that is
skin with eight times its blood: half comes from the table, half from looking blood up between ten
rows of an image. In type VI it is the light tan: a shader mixes colours of thin and of thick skin,
and what changes with the angle is that of skin as thick as it usually is with so much melanin.
"""

EDGE = """\
## A lit edge

Half of the patch is lit from straight above, the other half lies behind a sharp screen. The model's
light around the edge follows from how far from a pencil beam light leaves (random walk, 8
wavelengths of 100,000 rays), integrated over the lit half. Lines are Cycles, dashed lines the
model.

```{image} truth_edge.png
:alt: Light in three channels over the distance from the edge, for types II, IV and VI.
:width: 100%
```
"""

GLOSS = """\
## Gloss

A distant lamp at 8, 45 and 65 degrees, seen by a camera that sees every direction; what Cycles'
surface reflects is averaged over the bins of the model's BRDF (10,000,000 rays at the surface
alone). The distance is the integral of the difference over all directions, as a share of all that
the model's surface reflects.

The factor by the angle of view is right for even light, and for a lamp as far as the lobe is
narrow, as the types' is (s = .1). The thesis's rough specimens (s = .25 and .45) are nearer with it
under a lamp from the side, and shine too much towards the rim under one from the front: a factor of
the view alone cannot tell where the lamp is.

```{image} truth_gloss.png
:alt: The lobe in the plane of incidence, rendered and by the model.
:width: 100%
```
"""

SLAB = """\
## Lit from behind

A slab of skin with a distant lamp behind it, as an ear is lit. The model's slab is two skins back
to back without a hypodermis: each with all its layers, and between them the reticular dermis that
fills the thickness. Only fibres of the papillary dermis and melanosomes scatter in the model, so a
thicker slab differs by what its dermis absorbs.

```{image} truth_slab.png
:alt: Light through slabs of 1.5 to 4 mm in three channels, rendered and by the model.
:width: 100%
```
"""

FILM = """\
## Wet, oiled, sunscreen

The same with water, oil or sunscreen on the skin, types I, III and VI, untanned and dark. The model
solves a film of the liquid's refractive index with a flat face (`hylios/adding/film.py`); Cycles
shows it as a coat. What film and surface reflect is read from the glossy passes. In type VI the
numbers hold what is left without a film, too.
"""

BURN = """\
## Burnt, and tanned by it

Types III and VI after 2 minimal erythema doses on day 0, seen on days 1 and 10: by the add-on with
sunburn and with tans as measured in people. The model solves the skin itself, with a dermis that
fills with blood and does not thicken. A table's dermis thickens with all the rest, so that the
add-on looks up less blood for it (`hylios.skin.whole_thickening`).
"""

ILLUMINANTS = """\
## Other lamps

A table made for an illuminant (`lut-builder build --illuminant`, here with the preset preview) is
used under white lamps; the model says the reflected spectrum under the illuminant, adapted to its
white (Bradford). A table for D65 under a lamp of the illuminant's colour is farther off: a product
of three numbers of albedo and three of a lamp is no spectrum times a spectrum.
"""

ALIKE = """\
## What must not matter

Blender's working space, a studio's own OpenColorIO configuration (in ACEScg, with other names for
all colour spaces), the length of a scene unit and the scale of the object, each beside the usual
picture of the same skin. And what **Fit Skin to Size** mends: a model that is ten times life-size,
and a scene unit that changed after Apply.
"""

COST = """\
## Time

Processor time of a picture of a ball of skin beside the same with one plain Principled BSDF with
subsurface, five times by turns: the shortest of either, and the largest ratio of a turn. The ball
fills the picture, so that hardly anything else takes time.

Relief and variation, as a new material has them, take 1.9 times an even skin's time, with oil 2.1
(2 are asked of a new material, which a slow test holds): where a normal is given, Cycles evaluates
the shader again at every place where light leaves. Even skin is spared that since one node, which
Cycles leaves out, gives its normal.
"""

EEVEE = """\
## EEVEE

The half-lit patch in EEVEE and in Cycles, 3 mm and more from the edge of the light, and nearer,
without what the surface reflects, which outshines the rest straight below a lamp. EEVEE spreads
light over less of the skin than Cycles: beside the edge the lit half is brighter and the other
darker, which dies away with the distance (type III, dark: 2.0 at 3.6 mm, .9 at 9.9 mm).
Anisotropic Filtering is off, since without a graphics card (Mesa) it blurs tables, by up to 2
CIEDE2000.
"""

SECTIONS = {
    "albedo": ALBEDO,
    "edge": EDGE,
    "gloss": GLOSS,
    "slab": SLAB,
    "film": FILM,
    "burn": BURN,
    "illuminants": ILLUMINANTS,
    "alike": ALIKE,
    "cost": COST,
    "eevee": EEVEE,
}
