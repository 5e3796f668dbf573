"""Fields on a grid as compute sph/grid dumps them, and their spectra by numpy: the reference of compute sph/spectrum."""

import numpy as np

from sph_dissipation import read_array, read_grid     # noqa: F401, for the tests

COLUMNS = ("wave", "modes", "solenoidal", "dilatational", "enstrophy", "density", "kinetic", "spin")
TOTALS = ("solenoidal", "dilatational", "curl2", "div2", "power_curl", "power_div", "density2", "kinetic", "spin")


def wave_vectors(count, length):
    return np.stack(np.meshgrid(*[2 * np.pi / ell * np.fft.fftfreq(n, 1 / n) for n, ell in zip(count, length)],
                                indexing="ij"), axis=-1)


def spectra(length, field, dim, raise_modes=None):
    """Array and totals, from columns vx vy vz rho (and omegax omegay omegaz), as compute sph/spectrum defines them."""
    count = field.shape[:3]
    number = np.prod(count)
    k = wave_vectors(count, length)
    k2 = (k**2).sum(axis=-1)
    factor = 1.0 if raise_modes is None else raise_modes(np.sqrt(k2))

    def transform(values):
        return np.fft.fftn(values, axes=(0, 1, 2)) / number

    u = transform(field[..., :3])
    along = np.where(k2 > 0, (k * u).sum(axis=-1) / np.where(k2 > 0, k2, 1), 0)[..., None] * k
    half = {"modes": np.ones(count), "solenoidal": 0.5 * (abs(u - along)**2).sum(axis=-1) * factor,
            "dilatational": 0.5 * (abs(along)**2).sum(axis=-1) * factor,
            "enstrophy": 0.5 * (abs(np.cross(k, u))**2).sum(axis=-1) * factor,
            "density": abs(transform(field[..., 3]))**2 * factor,
            "kinetic": 0.5 * (abs(transform(np.sqrt(field[..., 3:4]) * field[..., :3]))**2).sum(axis=-1) * factor,
            "spin": 0.5 * (abs(transform(field[..., 4:7]))**2).sum(axis=-1) * factor}
    width = 2 * np.pi / length[:dim].max()
    shell = np.floor(np.sqrt(k2) / width + 0.5).astype(int)
    rows = shell.max() + 1
    array = np.zeros((rows, len(COLUMNS)))
    array[:, 0] = width * np.arange(rows)
    for column, name in enumerate(COLUMNS[1:], 1):
        array[:, column] = np.bincount(shell.ravel(), half[name].ravel(), rows) / (1 if name == "modes" else width)
    moving = k2 > 0
    totals = {name: half[name][moving].sum() for name in ("solenoidal", "dilatational")}
    totals.update(curl2=2 * half["enstrophy"][moving].sum(), density2=half["density"][moving].sum(),
                  div2=(abs((k * u).sum(axis=-1))**2 * factor)[moving].sum(), kinetic=half["kinetic"].sum(),
                  spin=half["spin"].sum())
    return array, totals
