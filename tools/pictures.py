#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Makes the pictures of the manual's start page from those of the examples: smaller, and with fewer colors.

    pictures.py      after ./sphd run NAME of the examples whose pictures have changed; needs Pillow, which matplotlib brings
"""
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[1]
PICTURES = ROOT / "doc" / "src" / "JPG"
WIDTH, COLORS = 1000, 96

# of the manual: of the example
SOURCES = {
    "sph_overview_pulse.png": "sound_pulse/velocity.png",
    "sph_overview_gas.png": "real_gas_sound/co2.png",
    "sph_overview_drop.png": "rotating_drop/angular_momentum.png",
    "sph_overview_cavity.png": "cavity/profiles.png",
    "sph_overview_cylinder.png": "cylinder/cylinder.png",
    "sph_overview_noise.png": "sound_spectrum/sound_spectrum.png",
    "sph_overview_turbulence.png": "compressible_turbulence/turbulence.png",
}


def reduced(source):
    picture = Image.open(ROOT / "examples" / source).convert("RGB")
    if picture.width > WIDTH:
        picture = picture.resize((WIDTH, round(picture.height * WIDTH / picture.width)), Image.LANCZOS)
    return picture.quantize(COLORS, dither=0)


def main():
    for name, source in SOURCES.items():
        reduced(source).save(PICTURES / name, optimize=True)


if __name__ == "__main__":
    main()
