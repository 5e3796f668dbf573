// What a run copies between host and device; loaded by LD_PRELOAD, and as a tool of Kokkos by KOKKOS_TOOLS_LIBS.  The file that COPIES
// names gets a line for each loop ("loop NAME"), for each copy of an array to another place in memory ("copy NAME BYTES"), and for each
// call that needs fields of particles which are newer on the other side ("to host MASK", "to device MASK").  A line "call SIDE MASK" is
// there for each call that names fields, also where host and device share their memory and nothing is copied.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>

namespace {
enum Side { HOST, DEVICE };
uint64_t newer[2];    // fields that are newer on this side

FILE *out()
{
  static FILE *const file = getenv("COPIES") ? fopen(getenv("COPIES"), "w") : nullptr;
  return file;
}

void call(Side side, uint64_t mask)
{
  if (out() && mask) fprintf(out(), "call %s %llx\n", side == HOST ? "host" : "device", static_cast<unsigned long long>(mask));
}

void need(Side side, uint64_t mask)
{
  call(side, mask);
  const uint64_t old = newer[1 - side] & mask;
  newer[1 - side] &= ~mask;
  if (out() && old) fprintf(out(), "to %s %llx\n", side == HOST ? "host" : "device", static_cast<unsigned long long>(old));
}
}    // namespace

// Stand before the functions of LAMMPS

namespace LAMMPS_NS {
enum ExecutionSpace { Host, HostKK, Device };

struct AtomKokkos {
  void sync(ExecutionSpace, uint64_t);
  void modified(ExecutionSpace, uint64_t);
  void sync_pinned(ExecutionSpace, uint64_t, int);
};

void AtomKokkos::sync(ExecutionSpace space, uint64_t mask)
{
  typedef void Function(AtomKokkos *, ExecutionSpace, uint64_t);
  static auto *const next = (Function *) dlsym(RTLD_NEXT, "_ZN9LAMMPS_NS10AtomKokkos4syncENS_14ExecutionSpaceEm");
  need(space == Device ? DEVICE : HOST, mask);
  next(this, space, mask);
}

void AtomKokkos::sync_pinned(ExecutionSpace space, uint64_t mask, int async)
{
  typedef void Function(AtomKokkos *, ExecutionSpace, uint64_t, int);
  static auto *const next = (Function *) dlsym(RTLD_NEXT, "_ZN9LAMMPS_NS10AtomKokkos11sync_pinnedENS_14ExecutionSpaceEmi");
  need(space == Device ? DEVICE : HOST, mask);
  next(this, space, mask, async);
}

void AtomKokkos::modified(ExecutionSpace space, uint64_t mask)
{
  typedef void Function(AtomKokkos *, ExecutionSpace, uint64_t);
  static auto *const next = (Function *) dlsym(RTLD_NEXT, "_ZN9LAMMPS_NS10AtomKokkos8modifiedENS_14ExecutionSpaceEm");
  const Side side = (space == Device) ? DEVICE : HOST;
  call(side, mask);
  newer[side] |= mask;
  newer[1 - side] &= ~mask;
  next(this, space, mask);
}
}    // namespace LAMMPS_NS

// Functions that Kokkos calls

struct SpaceHandle {
  char name[64];
};

extern "C" void kokkosp_begin_parallel_for(const char *name, uint32_t, uint64_t *)
{
  if (out()) fprintf(out(), "loop %s\n", name);
}

extern "C" void kokkosp_begin_deep_copy(SpaceHandle, const char *name, const void *to, SpaceHandle, const char *, const void *from,
                                        uint64_t bytes)
{
  if (out() && to != from) fprintf(out(), "copy %s %llu\n", name, static_cast<unsigned long long>(bytes));
}
