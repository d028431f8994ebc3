"""The text of docs/simplifications.md around its tables."""

INTRODUCTION = """
# Which part of the light model a scene needs

What each simplification of the light model costs in colour and buys in time, measured on the
specimens S1 to S4 and on the tan of each of them ({dose:g} SED on day 0; days {days}).
`make simplifications` measures again and writes this page.

Colours are CIEDE2000, mean and largest, between the simplified and the full model; 1 is about
what an eye can tell apart side by side. The full model has 61 wavelengths, 400 to 700 nm every
5 nm; its colours are compared with those of 360 to 780 nm every 5 nm.
"""

HEADS = """
- *S1 to S4*, *tans*: mean and largest CIEDE2000 without noise; in the rows of fewer rays, with it.
- *noise*: root mean square CIEDE2000 that a random walk adds by chance, with {rays:,} rays per
  wavelength unless the row says otherwise.
- *walk*: processor time of the random walk with as many rays per wavelength, the full model's
  with {rays:,} being 1. *same noise*: with as many rays as give the noise of the full model.
- *solver*: processor time of the deterministic solver (`hylios.adding`), the full model's being 1.
"""

HOW = """
Measured on {date} ({machine}) in {minutes:.1f} minutes of processor time. The costs of the model's
parts come from the deterministic solver, so they have no noise; noise follows from the reflectance
(how many rays come back is binomial), and for fewer rays it is drawn so. The walk itself, {rays:,}
rays at each of 61 wavelengths, differs from the solver's colours of S1 to S4 by {walked:.2f} on
average; chance alone would make it {chance:.2f}. What may be more is the solver's own error, which
the full and the simplified model share. Times are of one thread, the least of several
rounds of the same work, and ratios the mean of those on S1 to S4; on a busy machine they vary by
some 10 % from run to run.

For a colour alone, the solver needs 1/{solver:.0f} of the time of a walk with {rays_full:,} rays
per wavelength.
"""

CHOOSING = """
Gauss's nodes for daylight and the colour matching functions, with weights exact for polynomials,
are worse than even spacing: skin's reflectance is no polynomial, haemoglobin's bands being 30 nm
wide. The chosen wavelengths (`hylios.quadrature`) are those of the
5 nm grid, and the weights those for each channel, that give the least mean squared CIEDE2000 on
300 skins drawn at random around S1 to S4, none of which is measured here, with the noise of 1e7
rays counted as a part of it. Each channel's weights sum to 1, so grey stays that grey. They hold
for skin; what neither melanin nor blood colours may come out wrong. More than 16 are for the
solver, without that noise and for skin with up to 12 times its blood: 18 miss it by .002, 16 by
.013.

They are less noisy for the same number of rays than 61 even wavelengths: none is spent where the
eye sees little. With the walk, an even choice of fewer wavelengths buys nothing at the same noise;
the chosen ones buy a third to a half. With the solver, time falls with their number.
"""

WIDTHS = """
Burley's width d of a channel from some of the wavelengths, against all 61: mean difference over S1
to S4, of which chance is about 1 % where wavelengths are many and 2 % where they are few ({rays:,}
rays per wavelength). A wavelength may have a
negative weight in a channel. Taking its light away from the channel's profile is what colour does,
and what the table builder does; then few wavelengths do as well as all. Leaving negative weights
out (the columns *above 0 only*) has few wavelengths miss the width, and moves the width itself
whatever their number: with all 61, by {signed}.
"""

LINES = """
Without a profile a renderer gives each place its own colour, and the edge of a tan stays as sharp
as its mask. Away from edges the colour is the same. Here: untanned skin beside that of day {day},
light moved across the line by the walk's radial profiles in eight wavelengths. *tan* is CIEDE2000
between the two skins, the next columns the mean cost of the sharp edge up to a distance from the
line, the last the distance beyond which it is below {visible:g}. Half of what melanin absorbs is
absorbed on the way out, where the light already is on the other side; the true line is sharper than
this, and the costs are at most these.
"""

RENDERS = """
The walk keeps track of places in any case, so a profile costs it nothing. What leaving it out buys:
the solver alone makes the table; and Cycles renders a ball of skin with subsurface scattering
(Burley) in {render} times the processor time without.
"""

RENDERS_UNKNOWN = """
The walk keeps track of places in any case, so a profile costs it nothing. What leaving it out buys:
the solver alone makes the table, and a render is faster (not measured: Blender was not installed).
"""

BANDS = """
A ray takes, relative to the mean over the visible, {bands}. A table without these bands is as good
in the visible; next to eight chosen wavelengths, leaving all three out saves {saved:.0f} % of the
walk.
"""

NEEDS = """
- **Rayleigh scattering is needed by every scene**: without it skin is off by 7 and more.
- **Melanosomes as particles** take the walk two thirds of its time; colour is off by 1 to 3 without
  them. Where a look is all that is wanted, as for a crowd, they may be dissolved; a character in
  close-up needs them.
- **Three epidermal layers**: one layer misses by .7 on average and buys a third of the
  walk. Spreading melanin over the layers is worst on a tan, which moves it between them, and buys
  nothing.
- **Dysfunctional haemoglobins and carotene** cannot be seen; leaving them out buys next to nothing.
- **The angle of incidence**, 0 or 8 degrees, cannot be seen either.
- **Wavelengths**: eight chosen ones cannot be told from 61. More than that no scene needs; five
  are good enough for a preview.
- **Rays**: noise falls with the root of their number, and is what most of the time goes into. The
  solver has none: colours should come from it, and the walk give the profile, for which 10,000 rays
  at each of eight wavelengths are enough (3 % of the width).
- **The profile** is needed wherever the line of a tan is seen from near: it costs more than 1
  within 2 to 3 mm of the line. Where a pixel is wider than that, it is not.
- **Ultraviolet and infrared bands** only where they are rendered.
"""
