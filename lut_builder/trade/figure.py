"""The picture of what `lut_builder.trade.measurement` measured."""

from collections.abc import Iterator
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hylios.lab.pictures import write_figure
from lut_builder.trade.measurement import Trade
from lut_builder.trade.parts import Row
from lut_builder.trade.points import CORES, Point, named

SIZE_INCHES, DOTS_PER_INCH = (15.0, 9.0), 110
MARKS = ("o", "s", "^", "D", "v", "P", "X", "<", ">", "*")


def draw(trade: Trade, path: Path, title: str = "") -> None:
    """Draw the front, and all that can be traded, as PNG or SVG.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    figure = Figure(figsize=SIZE_INCHES, dpi=DOTS_PER_INCH, layout="constrained")
    places = figure.subplots(2, 3).ravel()
    _draw_front(places[0], trade)
    _draw_knots(places[1], trade.parts)
    _draw_solvers(places[2], trade.parts)
    _draw_profiles(places[3], trade.parts)
    _draw_wavelengths(places[4], trade.parts)
    _draw_components(places[5], trade.parts)
    for place in places:
        place.grid(alpha=0.25, which="both")
        place.title.set_fontsize(10)
        place.legend(fontsize=7)
    figure.suptitle(title, fontsize=9)
    write_figure(figure, path)


def _draw_front(place: Axes, trade: Trade) -> None:
    place.scatter(
        [point.seconds() for point in trade.points],
        [point.error for point in trade.points],
        s=2,
        color="0.8",
        label="all tables",
    )
    for colour, what, has_profile in (
        ("#d55e00", "with profile", True),
        ("#0072b2", "without", False),
    ):
        some = [point for point in trade.front if point.settings.has_profile is has_profile]
        place.plot(
            [point.seconds() for point in some],
            [point.error for point in some],
            "o-",
            ms=3,
            lw=1.2,
            color=colour,
            label=f"front, {what}",
        )
        for point in filter(named, some):
            _mark(place, point)
    place.set(
        xscale="log",
        yscale="log",
        xlabel=f"seconds on {CORES} cores, the start included",
        ylabel="largest CIEDE2000, colour and profile together",
        title="Tables: time against error",
    )


def _mark(place: Axes, point: Point) -> None:
    where = point.seconds(), point.error
    place.plot(*where, "k*", ms=11, zorder=5)
    place.annotate(
        named(point), where, textcoords="offset points", xytext=(7, 7), fontsize=9, zorder=6
    )


def _draw_knots(place: Axes, parts: list[Row]) -> None:
    for colour, (name, rows) in zip(
        ("#009e73", "#cc79a7"), _groups(parts, "knots, "), strict=False
    ):
        for style, which in (("-o", "mean"), ("--^", "largest")):
            place.plot(
                _numbers(rows, "seconds"),
                _numbers(rows, which),
                style,
                ms=4,
                lw=0.8,
                color=colour,
                label=f"{name}, {which}",
            )
        if name == "pchip":
            for row in rows:
                place.annotate(
                    row["setting"],
                    (float(row["seconds"]), float(row["mean"])),
                    textcoords="offset points",
                    xytext=(0, -9),
                    fontsize=6,
                    ha="center",
                )
    place.set(
        xscale="log",
        yscale="log",
        xlabel="seconds of one core for the colours",
        ylabel="CIEDE2000 between the knots",
        title="Knots and interpolation (8 wavelengths)",
    )
    place.tick_params(axis="x", which="minor", labelbottom=False)


def _draw_solvers(place: Axes, parts: list[Row]) -> None:
    for colour, name, label in (
        ("#0072b2", "nodes, spectrum", "adding, by nodes"),
        ("#d55e00", "rays, spectrum", "random walk, by rays"),
    ):
        rows = [row for row in parts if row["traded"] == name]
        milliseconds = [1e3 * seconds for seconds in _numbers(rows, "seconds")]
        place.plot(milliseconds, _numbers(rows, "mean"), "o-", color=colour, label=label)
        for row, at in zip(rows, milliseconds, strict=True):
            place.annotate(
                f"{row['setting']:,}",
                (at, float(row["mean"])),
                textcoords="offset points",
                xytext=(5, 4),
                fontsize=8,
            )
    place.set(
        xscale="log",
        yscale="log",
        xlabel="milliseconds of one core for one reflectance",
        ylabel="RMSE of reflectance",
        title="The two solvers, at single states and wavelengths",
    )


def _draw_profiles(place: Axes, parts: list[Row]) -> None:
    tables: list[str] = []
    for name, rows in _groups(parts, "profile, "):
        knots, _, wavelengths = name.partition(", ")
        first = knots not in tables
        if first:
            tables.append(knots)
        number = tables.index(knots)
        look = {"color": f"C{number % 10}", "lw": 0.9}
        style = ":" if wavelengths == "8 wavelengths" else "-"
        walked = [row for row in rows if not row["note"]]
        place.plot(_numbers(rows, "seconds"), _numbers(rows, "mean"), style, **look)
        place.plot(
            _numbers(walked, "seconds"),
            _numbers(walked, "mean"),
            MARKS[number % len(MARKS)],
            ms=3.5,
            color=look["color"],
            label=knots if first else None,
        )
    place.set(
        xscale="log",
        yscale="log",
        xlabel="seconds of one core for the profile",
        ylabel="rms error of the light beyond an edge",
        title="Profiles by states and error aimed at (dotted: 8 wavelengths;\nwithout mark: "
        "extrapolated)",
    )


def _draw_wavelengths(place: Axes, parts: list[Row]) -> None:
    rows = [row for row in parts if row["traded"] == "wavelengths"]
    counts = [int(row["setting"]) for row in rows]
    place.plot(counts, _numbers(rows, "mean"), "o-", label="wavelengths, mean")
    place.plot(counts, _numbers(rows, "largest"), "^--", label="wavelengths, largest")
    for row in parts:
        if row["traded"] == "nodes, colour":
            place.axhline(float(row["mean"]), color="0.5", lw=0.7, ls="-")
            place.annotate(
                f"{row['setting']} nodes",
                (counts[-1], float(row["mean"])),
                fontsize=7,
                ha="right",
                va="bottom",
            )
        if row["traded"] == "number" and row["setting"] == "half":
            half = float(row["largest"])
            place.axhline(half, color="#009e73", lw=0.9, ls="-.", label="16 bits, largest")
    place.set(
        yscale="log",
        xlabel="wavelengths of a colour",
        ylabel="CIEDE2000 at single states",
        title="Wavelengths, nodes and numbers of 16 bits",
    )


def _draw_components(place: Axes, parts: list[Row]) -> None:
    for name, rows in _groups(parts, "components, "):
        numbers = [int(row["note"].split()[0]) for row in rows]
        (line,) = place.plot(numbers, _numbers(rows, "mean"), "o-", label=f"{name}, mean")
        place.plot(
            numbers,
            _numbers(rows, "largest"),
            "^--",
            color=line.get_color(),
            label=f"{name}, largest",
        )
    place.set(
        xscale="log",
        yscale="log",
        xlabel="numbers kept for a state",
        ylabel="RMSE of the spectrum, 250 to 2500 nm",
        title="Principal components of a tan's spectra (appendix D)",
    )


def _groups(parts: list[Row], start: str) -> Iterator[tuple[str, list[Row]]]:
    """Rows by what is traded, of all whose name starts so, without that start."""
    names = dict.fromkeys(row["traded"] for row in parts if row["traded"].startswith(start))
    for name in names:
        yield name[len(start) :], [row for row in parts if row["traded"] == name]


def _numbers(rows: list[Row], column: str) -> list[float]:
    return [float(row[column]) for row in rows]
