"""Sphinx's settings. `make docs` builds the site into out/docs, with warnings as errors.

Sphinx with numpydoc reads the docstrings as they are; MkDocs would need them rewritten. MyST-NB
reads the pages in Markdown and runs the notebook. furo lays them out. Nothing is fetched: no
intersphinx, no fonts or scripts of other sites.
"""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

import hylios  # noqa: E402  # the path to it is set above

project = "Skin that tans"
author = "The skin-tan authors"
project_copyright = "the skin-tan authors"
release = hylios.__version__

extensions = ["sphinx.ext.autodoc", "numpydoc", "myst_nb"]
exclude_patterns = ["README.md"]
nitpicky = False

autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
# The docstrings say the types of parameters, with shapes and units; the hints add what comes back.
autodoc_typehints = "description"
autodoc_typehints_description_target = "documented_params"
numpydoc_show_class_members = False
default_role = "code"
highlight_language = "none"  # most blocks are shells; Python says so

myst_enable_extensions = ["colon_fence", "html_image"]
myst_heading_anchors = 4

nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 120
nb_execution_show_tb = True
nb_merge_streams = True

html_theme = "furo"
html_title = "Skin that tans"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_theme_options = {
    "light_css_variables": {
        "color-brand-primary": "#8a4b2d",
        "color-brand-content": "#8a4b2d",
    },
    "dark_css_variables": {
        "color-brand-primary": "#e0a985",
        "color-brand-content": "#e0a985",
    },
}
html_copy_source = False
html_show_sourcelink = False
