"""Sphinx configuration of the SPH-DISSIPATION documentation.

Build with ``sphinx-build -W -b html doc/src doc/build``.
"""

import importlib.util
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "_ext"))

project = "SPH-DISSIPATION"
author = "the SPH-DISSIPATION authors"
copyright = "the SPH-DISSIPATION authors; GNU General Public License, version 2"

needs_sphinx = "5.3"
extensions = ["sphinx.ext.mathjax", "lammps_pages", "local_mathjax"]
master_doc = "index"
exclude_patterns = ["Howto_sph_overview.rst"]    # a part of the start page
language = "en"

highlight_language = "none"
pygments_style = "default"

# the look of LAMMPS's own manual, where its theme is there (Debian: python3-sphinx-rtd-theme)
if importlib.util.find_spec("sphinx_rtd_theme"):
    html_theme = "sphinx_rtd_theme"
    html_theme_options = {"navigation_depth": 2, "collapse_navigation": False}
else:
    html_theme = "alabaster"
    html_theme_options = {"page_width": "1250px", "body_max_width": "none", "sidebar_width": "250px"}
html_static_path = ["_static"]
html_css_files = ["pages.css"]
html_title = "SPH-DISSIPATION"
html_show_sourcelink = False
