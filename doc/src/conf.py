"""Sphinx configuration of the SPH-DISSIPATION documentation.

Build with ``sphinx-build -W -b html doc/src doc/build``.
"""

import importlib.util
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "_ext"))

project = "SPH-DISSIPATION"
author = "the SPH-DISSIPATION authors"
with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "VERSION"), encoding="utf-8") as file:
    version = release = file.read().strip()
copyright = "the SPH-DISSIPATION authors; GNU General Public License, version 2"

needs_sphinx = "5.3"
extensions = ["sphinx.ext.mathjax", "lammps_pages", "local_mathjax"]
# lines of formulas that are wider than the page are broken
mathjax2_config = {"SVG": {"linebreaks": {"automatic": True}}}
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
html_favicon = "_static/favicon.svg"
html_css_files = ["pages.css"]
html_js_files = ["copy.js"]
html_title = f"SPH-DISSIPATION {release}"
html_show_sourcelink = False
