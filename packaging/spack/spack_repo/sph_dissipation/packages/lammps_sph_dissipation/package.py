# SPDX-License-Identifier: GPL-2.0-only

from pathlib import Path

from spack_repo.builtin.packages.lammps.package import Lammps

from spack.package import *

# The clone of SPH-DISSIPATION in which this file lies: its sources are built.
CLONE = Path(__file__).resolve().parents[6]


class LammpsSphDissipation(Lammps):
    """LAMMPS with the package SPH-DISSIPATION: viscous SPH fluids whose bulk viscosity is
    independent of the shear viscosity. The variants are those of Spack's recipe of LAMMPS."""

    # Never run by Spack: no Spack was at hand. Checked are the syntax, that Spack's own recipe
    # (api v2.2) has what is used here, and that LAMMPS 4 Jul 2026 configures with the arguments of
    # cmake_args(), without KOKKOS.
    # Spack's hash does not know CLONE: after a change of the clone, install with --overwrite.
    # A release with a public archive puts a resource() with its address and SHA-256 in the place of CLONE.

    # archives of LAMMPS as in cmake/ObtainLAMMPS.cmake; Spack's recipe has the same numbers
    version("20260704", sha256="be9deffba169d140c337fd29570d3f5469332ece7e77280cce998f6caaad5534")
    version("20250204", sha256="a4cb0a58451d47ac31ee3e1f148d92f445298d6e27f2d06f161b9b4168d79eb1")
    requires(
        "@=20260704",
        "@=20250204",
        policy="one_of",
        msg="SPH-DISSIPATION is tested with LAMMPS 4 Jul 2026 and 4 Feb 2025",
    )

    depends_on("cmake@3.21:", type="build")

    def cmake_args(self):
        return super().cmake_args() + [
            self.define("PKG_SPH-DISSIPATION", True),
            self.define(
                "CMAKE_PROJECT_lammps_INCLUDE", str(CLONE / "cmake" / "SPH-DISSIPATION.cmake")
            ),
        ]

    @run_after("install")
    def install_fluids(self):
        # the folder that Spack's recipe names by LAMMPS_POTENTIALS
        for file in ("fluids.sph", "gases.sph"):
            install(str(CLONE / "potentials" / file), self.prefix.share.lammps.potentials)
