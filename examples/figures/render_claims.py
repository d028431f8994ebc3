"""What the thesis says of figures 6.24 to 6.29, checked on renders."""

from collections.abc import Mapping, Sequence

import numpy as np

from blender_addon.model.views import VISIBLE
from examples.figures import report, shots
from examples.figures.render_results import Result
from examples.figures.render_sheet import Panel, Panels
from examples.figures.shots import UV
from examples.figures.tans import Schedule, history
from hylios.lab.colour import difference, lab, linear_of_srgb, srgb

NEAR = 2.0
"""How near in L* a render is to come to its table; what the shader's surface keeps out is 1."""
UV_EXPOSURE = 1.7
"""How much brighter than the visible pictures those at 365 nm are shown."""


def _totals(schedules: Sequence[Schedule]) -> str:
    totals = [f"{sum(dose for _, dose in schedule):.3g}" for schedule in schedules]
    return f"{', '.join(totals[:-1])} and {totals[-1]}" if len(totals) > 1 else totals[0]


HEADINGS = {
    "6.24": f"Patches of skin of low pigmentation (MMD {shots.MMD} SED). From the upper: "
    f"{_totals(shots.SCHEDULES)} SED in equal doses twice a week from day 0 on (assumed)",
    "6.25": "The same doses on three skins, day 20; upper to lower patch as under the pictures",
    "6.26": "Doses scaled by 1, 1.4 and 2.4, day 20; upper to lower patch as under the pictures",
    "6.27": "30 SED on day 0 beside sunscreen; low pigmentation, high tanning ability",
    "6.28": "30 SED on day 0 on one half of a face; low pigmentation, mild tanning ability",
    "6.29": "30 SED on day 0 beside a swimsuit; intermediate tanning set, day by day",
}
Rows = list[report.Row]


def readings_rows(by_figure: Mapping[str, Sequence[Result]]) -> Rows:
    """How near the renders come to the tables, and those to the light model."""
    rows = []
    for figure, results in by_figure.items():
        visible = [result for result in results if result.exact is not None]
        off = np.concatenate([lab(result.readings) - lab(result.predicted) for result in visible])[
            :, 0
        ]
        apart = np.concatenate([difference(result.predicted, result.exact) for result in visible])
        rows.append(
            report.Row(
                figure,
                f"L* read from {len(visible)} renders of skin without a film, less the table's",
                "",
                f"{np.nanmin(off):+.2f} to {np.nanmax(off):+.2f}; table from the light model "
                f"without noise: CIEDE2000 up to {np.nanmax(apart):.2f}",
                "none but in profile widths",
                f"within {NEAR:g}",
                bool(np.nanmax(np.abs(off)) <= NEAR),
            )
        )
        others = sorted({result.subject for result in results if result.subject == "Suzanne"})
        if others:
            rows.append(report.Row(figure, "subject", "a woman", "Suzanne stands in for her"))
    return rows


def schedules(results: Sequence[Result]) -> tuple[Panels, Rows]:
    """Panels of figure 6.24, and rows: is the skin darker under the stronger schedule?"""
    ordered = sorted(results, key=lambda result: result.shot.day)
    panels = [
        Panel(
            result.picture,
            f"day {result.shot.day:g}",
            shots.PATCHES if result.shot.window == shots.WHOLE else None,
        )
        for result in ordered
    ]
    later = [result for result in ordered if result.shot.day > 0]
    dark = np.array([result.lightness for result in later])
    rows = [
        report.claim(
            "6.24",
            "each stronger schedule leaves a darker patch, and all are darker than beside them",
            "so drawn",
            "; ".join(
                f"day {result.shot.day:g}: "
                + " ".join(f"{value:.1f}" for value in result.lightness)
                for result in later
            )
            + " (L* of upper, middle, lower, beside)",
            bool(np.all(np.diff(dark[:, [3, 0, 1, 2]], axis=1) < 0.0)),
        )
    ]
    return [panels], rows


def plain(results: Sequence[Result]) -> tuple[Panels, Rows]:
    """Panels of figure 6.25, and rows: do darker skins tan less of the same doses?"""
    panels, contrasts = _three_skins(results)
    weakest = contrasts["high"][0]
    less = all(
        np.all(np.diff([contrasts[name][part] for name in shots.SENSITIVITY]) < 0.0)
        for part in range(3)
    )
    return panels, [
        report.claim(
            "6.25",
            "the darker the skin, the less it tans of the same doses, in every patch",
            "so it is",
            _contrasts(contrasts),
            less,
        ),
        report.claim(
            "6.25",
            "weakest schedule on the darkest skin: no noticeable change",
            "not noticeable (here: CIEDE2000 below 1)",
            f"{weakest:.2f}",
            bool(weakest < 1.0),
        ),
        report.claim(
            "6.25",
            "the other schedules on the darkest skin (implied)",
            "noticeable",
            " and ".join(f"{value:.2f}" for value in contrasts["high"][1:]),
            bool(np.all(contrasts["high"][1:] >= 1.0)),
        ),
    ]


def matched(results: Sequence[Result]) -> tuple[Panels, Rows]:
    """Panels of figure 6.26, and rows: do they tan more of scaled doses?"""
    panels, contrasts = _three_skins(results)
    more = all(
        np.all(np.diff([contrasts[name][part] for name in shots.SENSITIVITY]) > 0.0)
        for part in range(3)
    )
    return panels, [
        report.claim(
            "6.26",
            "the darker the skin, the more noticeable the change, in every patch",
            "so it is",
            _contrasts(contrasts),
            more,
        )
    ]


def _three_skins(results: Sequence[Result]) -> tuple[Panels, dict[str, np.ndarray]]:
    panels = []
    for result in results:
        name = result.shot.table
        caption = f"{name} pigmentation\n{_totals(result.shot.schedules)} SED in all"
        panels.append(Panel(result.picture, caption))
    return [panels], {result.shot.table: result.contrast for result in results}


def _contrasts(contrasts: Mapping[str, np.ndarray]) -> str:
    listed = "; ".join(
        f"{name} " + " ".join(f"{value:.1f}" for value in values)
        for name, values in contrasts.items()
    )
    return f"CIEDE2000 of upper, middle, lower from beside: {listed}"


def strong(results: Sequence[Result]) -> tuple[Panels, Rows]:
    """Panels of figure 6.27, and rows: how dark is the strong tan on days 4 and 15?"""
    panels = [
        Panel(result.picture, "day 0, sunscreen on (outlined)", outlined=result.sun_distance)
        if result.shot.gloss
        else Panel(result.picture, f"day {result.shot.day:g}")
        for result in results
    ]
    contrasts = {result.shot.day: float(result.contrast[0]) for result in results}
    return [panels], [
        report.claim(
            "6.27",
            "noticeably darker on day 4, significantly on day 15",
            "so it is",
            ", ".join(
                f"day {day:g}: L* {result.lightness[0]:.1f}, CIEDE2000 {contrasts[day]:.1f} "
                "from under the sunscreen"
                for day, result in zip(contrasts, results, strict=True)
            ),
            bool(1.0 < contrasts[4] < contrasts[15]),
        ),
        _filling(),
    ]


def _filling() -> report.Row:
    """What so much melanin does to a layer, over the days of the figure."""
    skin = shots.skins()["strong"]
    over = history(skin, shots.BEACH, shots.LAST_DAY)
    cut = any(skin.overfull(state) for state in over.states)
    return report.Row(
        "6.27",
        "most melanin, as a multiple of the untanned skin's",
        "",
        f"{over.total.max():.2f}; " + ("cut to fill a layer" if cut else "it fits every layer"),
    )


def face(results: Sequence[Result]) -> tuple[Panels, Rows]:
    """Panels of figure 6.28, and rows: gloss of sunscreen, and the tan line at 365 nm."""
    seen, uv = (
        {result.shot.day: result for result in results if result.shot.view == view}
        for view in (VISIBLE, UV)
    )
    before, after = shots.FACE_DAYS
    said = {before: "before, sunscreen on one half", after: f"{after} days after"}
    panels = [
        [
            Panel(seen[day].picture, f"visible\n{said[day]}"),
            Panel(_brighter(uv[day].picture), f"365 nm\n{said[day]}"),
        ]
        for day in (before, after)
    ]
    bare, covered = seen[before].shine
    visible, at_365 = (_luminance(by_day[after].readings) for by_day in (seen, uv))
    return panels, [
        report.claim(
            "6.28",
            "the side under sunscreen is glossier",
            "so drawn",
            f"the surface reflects up to {covered:.2f} there, {bare:.2f} beside",
            bool(covered > bare),
        ),
        report.Row(
            "6.28",
            f"light out of tanned over covered skin on day {after}",
            "",
            f"{visible[0] / visible[1]:.2f} (visible, luminance), {at_365[0] / at_365[1]:.2f} "
            f"(365 nm); CIEDE2000 {seen[after].contrast[0]:.1f} in the visible",
        ),
    ]


def mild_beside_strong(back: Sequence[Result], faces: Sequence[Result]) -> report.Row:
    """Figures 6.27 and 6.28 on day 15."""
    high, mild = (
        next(
            result.contrast[0]
            for result in results
            if result.shot.day == 15 and result.shot.view == VISIBLE
        )
        for results in (back, faces)
    )
    return report.claim(
        "6.28",
        "tan line on day 15 fainter than with high tanning ability (6.27)",
        "so it is",
        f"CIEDE2000 {mild:.1f} and {high:.1f}",
        bool(mild < high),
    )


def _brighter(picture: np.ndarray) -> np.ndarray:
    """A picture at 365 nm, sRGB, brighter by `UV_EXPOSURE`."""
    return srgb(UV_EXPOSURE * linear_of_srgb(picture))


def _luminance(linear: np.ndarray) -> np.ndarray:
    return linear @ np.array([0.2126, 0.7152, 0.0722])


def month(results: Sequence[Result]) -> tuple[Panels, Rows]:
    """Panels of figure 6.29, and rows: rise, peak and fading over the month."""
    daily = [result for result in results if "small" in result.shot.name]
    main = [result for result in results if "small" not in result.shot.name]
    small = [Panel(result.picture, f"day {result.shot.day:g}") for result in daily]
    weeks = [small[start : start + 10] for start in range(0, len(small), 10)]
    lightness = np.array([result.lightness[0] for result in daily])
    days = np.array([result.shot.day for result in daily])
    darkest, untanned = lightness.min(), daily[0].lightness[1]
    change = (untanned - lightness) / (untanned - darkest)
    peak = days[np.argmin(lightness)]
    broad = days[change > 0.9]
    return [*weeks, [Panel(result.picture, f"day {result.shot.day:g}") for result in main]], [
        report.claim(
            "6.29", "day of the darkest skin", "10", f"{peak:g}", bool(8.0 <= peak <= 12.0)
        ),
        report.claim(
            "6.29",
            "rapid rise, broad maximum, gradual fading",
            "so it is",
            f"half of the largest change in L* ({untanned - darkest:.1f}) by day "
            f"{days[np.argmax(change > 0.5)]:g}; nine tenths from day {broad[0]:g} to "
            f"{broad[-1]:g}; on day {days[-1]:g} {change[-1]:.0%} are left",
            bool(
                broad[0] < broad[-1] - broad[0]
                and broad[0] < days[-1] - broad[-1]
                and change[-1] < 0.75
            ),
        ),
    ]
