"""Formulas without a network: the parts of a MathJax 2 on this machine that typeset TeX go into the manual.

The folder is that of Debian's package libjs-mathjax, or SPHD_MATHJAX in the environment; without one, pages load MathJax
from the address that Sphinx has for it.
"""

import os
import shutil

FOLDER = os.environ.get("SPHD_MATHJAX", "/usr/share/javascript/mathjax")
PARTS = ("MathJax.js", "config/TeX-AMS_SVG.js", "extensions", "jax/element", "jax/input/TeX", "jax/output/SVG")


def copy_parts(app, exception):
    if exception or app.builder.format != "html":
        return
    target = os.path.join(app.outdir, "_static", "mathjax")
    for part in PARTS:
        source, copy = os.path.join(FOLDER, part), os.path.join(target, part)
        if os.path.isdir(source):
            shutil.copytree(source, copy, dirs_exist_ok=True)
        else:
            os.makedirs(os.path.dirname(copy), exist_ok=True)
            shutil.copy(source, copy)


def setup(app):
    if os.path.exists(os.path.join(FOLDER, "MathJax.js")):
        app.config.mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG"
        app.connect("build-finished", copy_parts)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
