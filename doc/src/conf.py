"""Sphinx configuration of the SPH-DISSIPATION documentation.

Build with ``sphinx-build -W -b html doc/src doc/build``.
"""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "_ext"))

project = "SPH-DISSIPATION"
author = "the SPH-DISSIPATION authors"
copyright = "the SPH-DISSIPATION authors; GNU General Public License, version 2"

needs_sphinx = "5.3"
extensions = ["sphinx.ext.mathjax", "lammps_pages"]
master_doc = "index"
language = "en"

# formulas are typeset by MathJax in the reader's browser; a local copy serves readers without
# a network (Debian: package libjs-mathjax)
if os.environ.get("SPHD_MATHJAX"):
    mathjax_path = os.environ["SPHD_MATHJAX"]

highlight_language = "none"
pygments_style = "default"

html_theme = "alabaster"
html_theme_options = {
    "description": "Bulk viscosity, set freely, for LAMMPS's smoothed particle hydrodynamics",
    "fixed_sidebar": True,
    "page_width": "1250px",
    "body_max_width": "none",
    "sidebar_width": "250px",
}
html_title = "SPH-DISSIPATION"
html_show_sourcelink = False
