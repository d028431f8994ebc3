"""The notebook runs as it stands, and the code on the pages for researchers does."""

import json
import re
from pathlib import Path

import matplotlib
import pytest

ROOT = Path(__file__).parents[2]


def test_the_notebook_runs(monkeypatch):
    matplotlib.use("Agg")
    notebook = json.loads((ROOT / "docs" / "tan_in_numbers.ipynb").read_text(encoding="utf-8"))
    names = {}
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            assert not cell["outputs"], "outputs are made when the site is built: clear them"
            exec("".join(cell["source"]), names)  # noqa: S102  # the notebook is this project's
    darkest = names["colours"][list(names["shown"]).index(10)]
    assert darkest.difference(names["colours"][0]) == pytest.approx(8.1, abs=0.2)
    matplotlib.pyplot.close("all")


@pytest.mark.parametrize("page", ["README.md", "docs/research.md"])
def test_the_five_lines_of_the_pages_run(page, capsys):
    text = (ROOT / page).read_text(encoding="utf-8")
    (code,) = re.findall(r"```python\n(import hylios\n.*?)```", text, re.DOTALL)
    exec(code, {})
    assert capsys.readouterr().out
