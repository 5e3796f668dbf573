// The two pair loops of a device in the form that most runs have, see cuda.py

#include "atom_kokkos.h"
#include "neigh_list_kokkos.h"
#include "sph_dissipation_kernel.h"
#include "sph_dissipation_loops_kokkos.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

void run_loops(const LoopDataKokkos<LMPDeviceType> &data, int n)
{
  typedef ForceLoopKokkos<LMPDeviceType, Lucy, Form<AlongR<false>>, false> Force;
  const Kokkos::RangePolicy<LMPDeviceType> range(0, n);
  Kokkos::parallel_for("density", range, DensityLoopKokkos<LMPDeviceType, Lucy>{data});
  Kokkos::parallel_for("forces", range, VirialLoopKokkos<Force>{Force{data}});
}
