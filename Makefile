# make demo | example | gallery | figures | truth | test | test-all | bench | docs | package | constraints: all but the
# last set up what they need in VENV first.
# PYTHON=... picks the interpreter: 3.11 (Blender 5.0, or BPY=4.5.x) or 3.13 (Blender 5.2 LTS). All
# packages have the versions of constraints/.
PYTHON ?=
VENV ?= .venv
BIN := $(VENV)/bin

.PHONY: demo example gallery figures truth simplifications agreement test test-all lint bench docs package environment

environment:
	@tools/environment.sh $(VENV) $(PYTHON)

demo: environment
	@$(BIN)/python -m examples.demo

# A .blend to look at: a body, its clothes, two times in the sun, into out/example.blend.
example: environment
	@$(BIN)/python -m examples.example_file

# Faces, shoulders and hands of new materials, near and far, in two lights: out/gallery.
gallery: environment
	@$(BIN)/python -m examples.gallery

figures: environment
	@$(BIN)/python -m examples.figures $(if $(PEOPLE),--people "$(PEOPLE)") \
	    $(if $(PAGE),--page $(PAGE)) $(FIGURES)

lint: environment
	$(BIN)/ruff check .
	$(BIN)/basedpyright --pythonpath $(BIN)/python

# A file's tests stay in one process: they share what is made once for the file. Each process
# compiles, tabulates and imports Blender for itself, so many bring little.
test: lint
	$(BIN)/python -m pytest -m "not slow" -n logical --maxprocesses 4 --dist loadfile

test-all: lint
	$(BIN)/python -m pytest

bench: environment
	@$(BIN)/python -m examples.bench

# Measures what each part of the light model costs and is worth, and writes the page in docs/.
simplifications: environment
	@$(BIN)/python -m examples.simplifications

# Renders skin and compares it with the light model; with ONLY=edge that alone, else the page too.
# BESIDE is the output folder of a run with another Blender, to stand beside this one.
truth: environment
	@$(BIN)/python -m examples.truth $(if $(ONLY),--only $(ONLY),--page docs/truth.md) \
	    $(if $(BESIDE),--beside $(BESIDE)) $(if $(OUT),--out $(OUT))

# How well the solver without noise agrees with the random walk: hours, or with RAYS=1000000 half
# an hour.
agreement: environment
	@$(BIN)/python -m examples.agreement $(if $(RAYS),--rays $(RAYS))

# The site, into out/docs. What only Sphinx needs is installed once; building fetches nothing.
docs: environment
	@$(BIN)/python -c "import furo, myst_nb, numpydoc" 2>/dev/null || \
	    $(BIN)/python -m pip install --quiet --disable-pip-version-check \
	        --constraint $(VENV)/constraints.txt --editable ".[docs]"
	@$(BIN)/python -m sphinx -W --keep-going -q -b html docs out/docs
	@echo "out/docs/index.html"

# The newest versions of all packages, for each Python here, into constraints/.
.PHONY: constraints
constraints:
	@tools/pythons.sh | while read -r version python; do $$python tools/constraints.py || exit; done

package: environment
	@$(BIN)/python -m blender_addon.package

# What a release attaches, into dist: the extension's zip, the wheel and its sources.
.PHONY: release
release: package
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check \
	    --constraint $(VENV)/constraints.txt --editable ".[release]"
	@SOURCE_DATE_EPOCH=$$(git log -1 --format=%ct) $(BIN)/python -m build --outdir dist >/dev/null

# The tables that the add-on carries; each takes some ten seconds.
TABLES := I II III IV V VI S1 S2 S3 S4
.PHONY: tables
tables: environment
	@for name in $(TABLES); do \
	    $(BIN)/lut-builder build --specimen $$name --force -o blender_addon/tables/$$name.exr || exit; \
	done
