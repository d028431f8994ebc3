"""Spectra read from CSV, plots and swatches, and their commands."""

import io
import subprocess
import sys

import numpy as np
import pytest
from matplotlib.image import imread

from hylios.commands.cli import main
from hylios.errors import InputError
from hylios.files import require_target, written_beside
from hylios.lab import colour
from hylios.lab.pictures import spectra_figure, swatches, write_figure
from hylios.pseudo_colour import TINTS
from hylios.readers.spectrum import NamedSpectrum, read_spectrum

HEADER = "wavelength_nm,total,surface,subsurface,absorptance,standard_error"


@pytest.fixture
def grey(tmp_path):
    """A reflectance of .25 everywhere, as `hylios reflectance` would print it."""
    path = tmp_path / "grey.csv"
    rows = [f"{nanometres},0.25,0.05,0.2,0.75,0.01" for nanometres in range(250, 2501, 50)]
    path.write_text("\n".join([HEADER, *rows]) + "\n")
    return path


def test_a_printed_spectrum_is_read_back(tmp_path, capsys):
    main("reflectance --wavelengths 500,600,700 --rays 100".split())
    path = tmp_path / "S3.csv"
    path.write_text(capsys.readouterr().out)
    spectrum = read_spectrum(path)
    assert spectrum.name == "S3"
    assert spectrum.wavelengths.tolist() == [500.0, 600.0, 700.0]
    assert np.all((spectrum.reflectance > 0.0) & (spectrum.reflectance < 1.0))
    assert spectrum.standard_error is not None
    assert np.all(spectrum.standard_error > 0.0)


def test_the_mean_over_a_band_is_that_of_the_line_between_the_points():
    wavelengths = np.array([200.0, 300.0, 500.0])
    reflectance = np.array([0.1, 0.3, 0.7])  # 0.2 at 250, 0.5 at 400
    mean = colour.band_reflectance(wavelengths, reflectance, "uv")
    assert mean == pytest.approx((0.25 * 50.0 + 0.4 * 100.0) / 150.0)


def test_swatches_of_a_grey_are_grey_or_tinted():
    wavelengths, reflectance = np.array([250.0, 2500.0]), np.array([0.25, 0.25])
    assert colour.swatch(wavelengths, reflectance, "visible") == pytest.approx([0.25] * 3)
    for band, tint in TINTS.items():
        swatch = colour.swatch(wavelengths, reflectance, band)
        assert swatch == pytest.approx(0.25 * np.array(tint))
        assert max(tint) == 1.0
    assert np.argmax(TINTS["uv"]) == 2
    assert np.argmax(TINTS["ir"]) == 0


def test_a_visible_swatch_does_not_see_beyond_its_band():
    wavelengths = np.array([250.0, 399.9, 400.0, 700.0, 700.1, 2500.0])
    reflectance = np.array([0.9, 0.9, 0.2, 0.2, 0.9, 0.9])
    assert colour.swatch(wavelengths, reflectance, "visible") == pytest.approx([0.2] * 3)


def test_swatches_stand_side_by_side():
    pixels = swatches(np.array([[1.0, 0.0, 0.5], [0.2, 0.4, 0.6]]), 3)
    assert pixels.shape == (3, 6, 3)
    assert pixels.dtype == np.uint8
    assert np.all(pixels[:, :3] == [255, 0, 128])
    assert np.all(pixels[:, 3:] == [51, 102, 153])


def test_the_command_writes_the_swatch_of_a_file(tmp_path, grey, capsys):
    target = tmp_path / "grey.png"
    assert main(["swatch", str(grey), str(grey), "-o", str(target), "--size", "8"]) == 0
    code = round(255 * float(colour.srgb(np.array(0.25))))
    assert f"#{code:02x}{code:02x}{code:02x}" in capsys.readouterr().out
    pixels = np.round(255 * imread(target)[..., :3])
    assert pixels.shape == (8, 16, 3)
    assert np.all(pixels == code)
    infrared = tmp_path / "ir.png"
    assert main(["swatch", str(grey), "--band", "ir", "-o", str(infrared), "--size", "8"]) == 0
    expected = np.round(255 * colour.srgb(0.25 * np.array(TINTS["ir"])))
    assert np.all(np.round(255 * imread(infrared)[..., :3]) == expected)


def test_the_command_simulates_a_specimen(tmp_path, capsys):
    """Skin is redder than it is green, greener than it is blue, and S4 darker than S3."""
    colours = []
    for name in ("S3", "S4"):
        target = tmp_path / f"{name}.png"
        command = f"swatch --specimen {name} --rays 300 --step 20 --size 1 -o {target}"
        assert main(command.split()) == 0
        assert name in capsys.readouterr().out
        colours.append(imread(target)[0, 0, :3])
    for red, green, blue in colours:
        assert red > green > blue
    assert colours[1].max() < colours[0].max()


def test_the_choice_of_bands_is_that_of_the_colours(tmp_path):
    for band in colour.BANDS:
        target = tmp_path / f"{band}.png"
        command = f"swatch --band {band} --rays 1 --step 50 --size 1 -o {target}"
        assert main(command.split()) == 0


SPECTRA = [
    NamedSpectrum("_a $x$", np.array([400.0, 500.0]), np.array([0.2, 0.3]), np.array([0.01, 0.02])),
    NamedSpectrum("b", np.array([450.0]), np.array([0.5]), None),
]


def test_a_figure_has_lines_bands_units_and_a_legend():
    axes = spectra_figure(SPECTRA).axes[0]
    assert [line.get_ydata().tolist() for line in axes.lines] == [[0.2, 0.3], [0.5]]
    (band,) = axes.collections
    heights = band.get_paths()[0].vertices[:, 1]
    assert heights.min() == pytest.approx(0.19)
    assert heights.max() == pytest.approx(0.32)
    legend = axes.get_legend()
    assert legend is not None
    assert [text.get_text() for text in legend.get_texts()] == ["_a $x$", "b"]
    assert axes.get_xlabel() == "wavelength (nm)"
    assert axes.get_ylabel() == "reflectance"


@pytest.mark.parametrize("kind", ["png", "svg"])
def test_equal_figures_give_equal_files(tmp_path, kind):
    written = []
    for name in ("one", "two"):
        write_figure(spectra_figure(SPECTRA), tmp_path / f"{name}.{kind}")
        written.append((tmp_path / f"{name}.{kind}").read_bytes())
    assert written[0] == written[1]
    start = b"\x89PNG" if kind == "png" else b"<?xml"
    assert written[0].startswith(start)
    assert b"<dc:date>" not in written[0]


def test_plot_reads_files_and_standard_input(tmp_path, grey, capsys, monkeypatch):
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(grey.read_bytes())))
    target = tmp_path / "spectra.svg"
    assert main(["plot", str(grey), "-", "-o", str(target)]) == 0
    assert "grey, standard input" in capsys.readouterr().out
    assert target.stat().st_size > 1000
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(grey.read_bytes())))
    assert main(["plot", "-", "-", "-o", str(target), "--force"]) == 2
    assert "standard input is given twice" in capsys.readouterr().err


def test_an_existing_file_is_replaced_only_when_asked_to(tmp_path, grey, capsys):
    target = tmp_path / "old.png"
    target.write_text("old")
    for command in ("plot", "swatch"):
        assert main([command, str(grey), "-o", str(target)]) == 2
        assert "exists already; --force replaces it." in capsys.readouterr().err
        assert target.read_text() == "old"
    assert main(["plot", str(grey), "-o", str(target), "--force"]) == 0
    assert target.read_bytes().startswith(b"\x89PNG")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["grey.csv", "old.png"]


def test_a_failure_leaves_the_old_file_and_nothing_else(tmp_path):
    target = tmp_path / "old.png"
    target.write_text("old")
    with pytest.raises(InputError, match="cannot be written: No space"), written_beside(target):
        raise OSError(28, "No space left on device")
    with pytest.raises(KeyboardInterrupt), written_beside(target) as beside:
        beside.write_text("half")
        raise KeyboardInterrupt
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_a_target_is_checked_before_the_work(tmp_path):
    require_target(tmp_path / "new.PNG", (".png",), False)
    for target, sentence in (
        (tmp_path / "new.jpg", "its name must end in .png"),
        (tmp_path / "none" / "new.png", "cannot be written: No such file"),
    ):
        with pytest.raises(InputError, match=sentence):
            require_target(target, (".png",), True)
    (tmp_path / "folder.png").mkdir()
    with pytest.raises(InputError, match="it is a folder"):
        require_target(tmp_path / "folder.png", (".png",), True)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ("plot {grey} -o {to}.pdf", "its name must end in .png or .svg"),
        ("plot {to}.csv -o {to}.png", "cannot be read"),
        ("swatch {grey} --specimen S3 -o {to}.png", "give only one"),
        ("swatch {grey} --size 0 -o {to}.png", "size is 0"),
        ("swatch --step 0 -o {to}.png", "step is 0 nm"),
        ("swatch --rays 0 -o {to}.png", "number of rays is 0"),
        ("swatch --specimen S9 -o {to}.png", "there is no specimen 'S9'"),
        ("swatch --seed -1 -o {to}.png", "seed is -1"),
    ],
)
def test_bad_input_is_one_sentence_and_status_2(tmp_path, grey, capsys, arguments, sentence):
    to = tmp_path / "to"
    assert main(arguments.format(grey=grey, to=to).split()) == 2
    printed = capsys.readouterr()
    assert sentence in printed.err
    assert printed.err.count("\n") == 1
    assert printed.out == ""
    assert not list(tmp_path.glob("to*"))


def test_a_spectrum_that_does_not_span_the_band_is_refused(tmp_path, capsys):
    path = tmp_path / "short.csv"
    path.write_text("wavelength_nm,total\n420,0.1\n700,0.2\n")
    assert main(["swatch", str(path), "-o", str(tmp_path / "to.png")]) == 2
    assert "spans 420 to 700 nm; a swatch of the band visible needs 400" in capsys.readouterr().err


def test_pictures_need_no_display_and_no_pyplot(tmp_path, grey):
    target = tmp_path / "spectra.png"
    code = (
        "import sys; sys.modules['matplotlib.pyplot'] = None; sys.modules['numba'] = None;"
        "from hylios.commands.cli import main;"
        f"sys.exit(main(['plot', {str(grey)!r}, '-o', {str(target)!r}]))"
    )
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
