# SPDX-License-Identifier: GPL-2.0-only
"""Figures with the style of the examples and of the manual."""
from pathlib import Path

STYLE = Path(__file__).with_name("sph.mplstyle")    # for matplotlib.pyplot.style.use


def pyplot():
    """matplotlib.pyplot for files, with the style of all figures: sph.mplstyle."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.style.use(STYLE)
    return plt


def save(figure, path, legends=()):
    """Write a figure and forget it; legends: axes that get one. Returns the path. A PNG has 256 colors, a quarter of the bytes."""
    for axes in legends:
        axes.legend()
    figure.savefig(path)
    pyplot().close(figure)
    if Path(path).suffix == ".png":
        reduce_colors(path)
    return path


def reduce_colors(path):
    """Replace an opaque PNG by one with the 256 colors that are nearest to its own."""
    from PIL import Image

    with Image.open(path) as picture:
        colors = picture.convert("RGB")
    colors.quantize(256, method=Image.Quantize.MAXCOVERAGE, kmeans=4, dither=Image.Dither.NONE).save(path, optimize=True)
