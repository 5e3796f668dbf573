"""fix sph/open: what is wrong with an input is said, on any number of ranks."""

import re

import pytest

from open_boundaries import Channel, errors

U = 0.1
INLET, OUTLET = f"velocity {U} 0 0", "density 1.0"


def refused(lammps, message, inlet=INLET, outlet=OUTLET, ranks=(1, 2), run="run 100\n", channel=None, edit=None, **keywords):
    channel = channel or Channel()
    text = channel.text(lammps, inlet, outlet, velocity=lambda place: place * 0 + [U, 0, 0], **keywords) + run
    for number in ranks:
        result = lammps(edit(text) if edit else text, ranks=number, check=False, timeout=60)
        assert result.code != 0, "accepted"
        assert re.search(message, errors(result)), errors(result) or result.output[-800:]


# ---------------------------------------------------------------------------------------------
# keywords


@pytest.mark.parametrize("inlet, message", [
    ("velocity 0.1 0", "missing arg|Illegal fix sph/open|variable|Unknown|Expected"),
    ("velocity 0.1 0 0 speed 3", "Unknown fix sph/open keyword: speed"),
    ("velocity 0.1 0 0 density 1.0 pressure 0.0", "density and pressure cannot both be given"),
    ("velocity 0.1 0 0 order 1", "order is for values from inside with condition fixed"),
    ("velocity 0.1 0 0 density 1.0 average 5", "average is for values from inside"),
    ("velocity 0.1 0 0 condition fixed average 5", "average is for values from inside"),
    ("velocity inside", "needs a velocity, a density, or a pressure"),
    ("velocity 0.1 0 0 area 1.0", "area needs a density"),
    ("velocity 0.1 0 0 density 1.0 area 1.0 spacing 1.0", "area and spacing cannot both be given"),
    ("velocity 0.1 0 0 energy inside", "Expected floating point parameter"),
    ("velocity 0.1 0 0 spin inside 0 0", "Expected floating point parameter|spin requires"),
    ("velocity 0.1 0 0 spin 0 0 1", "spin requires atom style sph/micropolar"),
    ("velocity 0.1 0 0 spacing 0", "spacing must be > 0"),
    ("velocity 0.1 0 0 average -1", "average must be > 0"),
    ("velocity 0.1 0 0 condition sideways", "condition must be lagged, characteristic, or fixed, not sideways"),
    ("velocity 0.1 0 0 order 2", "order must be 0 or 1"),
    ("velocity 0.1 0 0 region nowhere", "region nowhere does not exist"),
    ("velocity 0.1 0 0 region travels", "region travels must not move or change"),
    ("velocity v_none 0 0", "Variable none for .*sph/open does not exist"),
    ("velocity v_ 0 0", "Variable +for .*sph/open does not exist"),
    ("velocity v_word 0 0", "neither of equal style nor of atom style"),
    ("velocity v_nan 0 0", "variable nan is -?nan"),
    ("velocity v_nanatom 0 0", "variable nanatom is -?nan for particle"),
    ("velocity 0.1 0 0 density v_behind area 1.0", "gives -.* as the distance from the next one"),
    ("velocity 0.1 0 0 density v_late area 1.0", "variable late is|distance from the next one|would have density"),
    ("velocity 0.1 0 0.2", "0.2 cannot be used: velocity must lie in the plane in 2d"),
    ("velocity 0.1 0 v_late", "variable late is .* at step 0: velocity must lie in the plane in 2d"),
    ("velocity 0.1 0 v_behind", "variable behind is .* for particle .* at step 0: velocity must lie in the plane in 2d"),
    ("velocity 0.1 0 0 density -1.0", "would have density|density"),
    ("velocity 0.1 0 0 pressure -2.0", "would have density"),
])
def test_keywords(lammps, inlet, message):
    variables = ("variable word string x\nvariable nan equal 0.0*exp(1000.0)\nvariable nanatom atom 0.0*exp(-1000.0*x)\n"
                 "variable late equal 1.0-0.5*step\nvariable behind atom 1.0-2.0*(x<-7.9)\n"
                 "region travels block -99 99 -99 99 -1 1 units box move v_late NULL NULL\n")
    refused(lammps, message, inlet=inlet, before=variables)


@pytest.mark.parametrize("eos, keywords, pressure", [("tait", "gamma 7.0", -0.15), ("tait", "gamma 7.0 pb 0.5", 0.35), ("ideal", "pb 0.5", 0.4)])
def test_pressure_that_no_density_has(lammps, eos, keywords, pressure):
    energy = " energy 2.5" if eos == "ideal" else ""
    refused(lammps, "would have density", inlet=f"{INLET} pressure {pressure}{energy}", outlet=f"pressure 1.0{energy}", ranks=(2,),
            options=f"eos {eos}", coeff=f"1.0 1.0 0.1 0.2 {{R}} {keywords}")


def test_variable_that_becomes_nan_in_the_run(lammps):
    refused(lammps, "variable late is -?nan at step 51", inlet="velocity v_late 0 0",
            before="variable late equal 0.1+0.0*exp(1000.0*(step>50))\n", run="run 100\n")


@pytest.mark.parametrize("spin", ["1 0 0", "0 1 0", "v_one 0 0", "0 v_each 0"])
def test_spin_out_of_the_plane(lammps, spin):
    refused(lammps, "spin must be along z in 2d", inlet=f"{INLET} spin {spin}", ranks=(2,), style="sph/micropolar",
            coeff="1.0 1.0 0.1 0.2 0.05 0.05 -0.05 {R}", integrate="density rho0 inertia 0.1 0.01",
            before="variable one equal 1\nvariable each atom 1+x\n")


@pytest.mark.parametrize("energy", ["0", "-3", "v_none", "v_cold"])
def test_energy_of_an_ideal_gas(lammps, energy):
    """Without energy, a gas has no pressure: also if it was not given, and the particles have none."""
    words, message = f"{INLET} energy {energy}", "energy must be > 0 with eos ideal"
    if energy == "v_none":
        words, message = INLET, "particle .* has an internal energy of 0 per mass at step 0, from which eos ideal makes no pressure"
    refused(lammps, message, inlet=words, outlet="pressure 1.0 energy 2.5", ranks=(2,), options="eos ideal",
            before="variable cold atom 1+x\n")


@pytest.mark.parametrize("change, message", [
    (("8.0 velocity", "-8.0 velocity"), "length must be > 0"),
    (("in sph/open fluid 0.0 0.0 0.0 1.0 0.0 0.0", "in sph/open fluid 0.0 0.0 0.0 0.0 0.0 0.0"), "must not be zero"),
    (("in sph/open fluid 0.0 0.0 0.0 1.0 0.0 0.0", "in sph/open fluid 0.0 0.0 0.0 1.0 0.0 1.0"), "must lie in the xy plane"),
    (("in sph/open fluid 0.0 0.0 0.0 1.0 0.0 0.0", "in sph/open fluid 0.0 0.0 0.0 -1.0 0.0 0.0"),
     "the plane .* which must point into the fluid"),
    (("in sph/open fluid 0.0 0.0 0.0 1.0 0.0 0.0", "in sph/open fluid 0.0 0.0 0.0 1.0 0.2 0.0"), "periodic in y and the plane crosses"),
    (("in sph/open fluid 0.0 0.0 0.0 1.0 0.0 0.0", "in sph/open fluid 0.0 0.0 0.0 1.0 0.1 0.0"), "periodic in y and the plane crosses"),
    (("in sph/open fluid 0.0 0.0 0.0 1.0", "in sph/open fluid 3.0 0.0 0.0 1.0"), "of the fluid are behind the plane"),
    (("fix in in", "fix X in sph/open\nfix in in"), "Illegal fix sph/open command: missing argument"),
    (("in sph/open fluid", "in sph/open liquid"), "group liquid does not exist"),
    (("in sph/open fluid", "in sph/open in"), "must be two"),
    (("in sph/open fluid", "in sph/open all"), "must be two"),
    (("fix out out", "fix out in"), "has the zone of fix (in|out) already"),
    (("fix 1 fluid", "fix 1 all"), "are also moved by fix 1 of style sph/bulk|both integrate"),
    (("fix 1 fluid", "fix 2 in nve\nfix 1 fluid"), "are also moved by fix 2 of style nve"),
    (("fix 1 fluid sph/bulk density rho0", ""), "requires fix sph/bulk"),
    (("fix 1 fluid", "group wet union fluid\nfix 1 wet"), "no fix sph/bulk or sph/micropolar of group fluid"),
    (("fix 1 fluid", "group fluid dynamic all every 10\nfix 1 fluid"), "dynamic group fluid"),
    (("fix in in", "group in dynamic all every 10\nfix in in"), "dynamic group in"),
    (("run 100", "group fluid dynamic all every 10\nrun 100"), "dynamic group fluid"),
    (("boundary f p p", "boundary s p p"), "must not be shrink-wrapped across the zone, use boundary f for x"),
    (("boundary f p p", "boundary m p p"), "must not be shrink-wrapped across the zone, use boundary f for x"),
    (("fix in in", "fix D all deform 1 y erate 0.01\nfix in in"), "cannot be used with fix deform"),
    (("atom_style sph/bulk", "atom_style sph/bulk\natom_modify id no"), "requires atom IDs|atom IDs|atom ID"),
    (("atom_style sph/bulk", "atom_style sph/bulk\natom_modify map yes first fluid"), "atom_modify first"),
    (("run 100", "run_style respa 2 2\nrun 100"), "respa"),
    (("run 100", "minimize 0 1e-6 10 10"), "cannot be used in a minimization"),
    (("run 100", "dump D all custom 1 rerun.dump id x y vx vy\nrun 1\nrerun rerun.dump dump x y vx vy"), "cannot be used with rerun: "),
    (("fix in in", "delete_atoms group in\nfix in in"), "group in is empty"),
    (("group in id", "group fluid id 1:10\ngroup in id"), "are in both groups in and fluid"),
    (("pair_style sph/bulk", "pair_style zero 3.0\npair_coeff * *\n#"), "requires pair style|pair_coeff|Incorrect"),
    (("run 100", "pair_style zero 3.0\npair_coeff * *\nrun 100"), "requires pair style"),
    (("run 100", "group in clear\nrun 100"), "group in is empty"),
    (("run 100", "neigh_modify exclude group in fluid\nrun 100"), "leaves out pairs of the zone with the fluid or with itself"),
    (("run 100", "neigh_modify exclude group in in\nrun 100"), "leaves out pairs of the zone with the fluid or with itself"),
    (("run 100", "neigh_modify exclude type 1 1\nrun 100"), "leaves out pairs of the fluid of type 1"),
    (("run 100", "group water union fluid\nneigh_modify exclude group water in\nrun 100"), "leaves out pairs of the zone"),
    (("run 100", "neigh_modify once yes\nrun 100"), "needs new neighbor lists: neigh_modify once must be no"),
    (("timestep 0.3", "timestep -0.3"), "the time step must not be negative"),
])
def test_setup(lammps, change, message):
    before, after = change
    def edit(text):
        assert before in text
        return text.replace(before, after)
    refused(lammps, message, edit=edit)


# ---------------------------------------------------------------------------------------------
# zones


def test_zone_too_short(lammps):
    """The message says how long it must be: two supports, one spacing, the skin."""
    channel = Channel()
    channel.zone = 7.4
    refused(lammps, r"the zone must be at least 7\.53 long, not 7\.4", channel=channel)


@pytest.mark.parametrize("region, message", [
    ("INF INF 2 5", "40 particles of group in are outside of region tube, which must contain the zone"),
    ("INF INF 0 7.4", "8 particles of group in are outside of region tube"),
    ("-7 INF INF INF", "8 particles of group in are outside of region tube"),
    ("INF 0.5 INF INF", r"region tube must reach 2\.2 into the fluid, where its state is measured.* for 64 of them"),
    ("INF 2.1 INF INF", r"region tube must reach 2\.2 into the fluid"),
])
@pytest.mark.parametrize("box", ["straight", "free"])
def test_region_that_does_not_fit_the_zone(lammps, region, message, box):
    refused(lammps, message, inlet=f"{INLET} region tube", ranks=(2,), channel=Channel(box=box),
            before=f"region tube block {region} INF INF\n", edit=lambda text: move(text, "region tube", "pair_style"))


def move(text, line, before):
    """A line of the input to another place."""
    (found,) = [one for one in text.splitlines(True) if one.startswith(line)]
    return text.replace(found, "").replace(before, found + before, 1)


def test_zone_that_drifts_out_of_its_region(lammps):
    """By more than half a row, at a later list of neighbors."""
    refused(lammps, "particles of group in are outside of region tube", inlet="velocity 0.1 0.2 0 region tube", ranks=(1, 2),
            channel=Channel(box="free"), before="region tube block INF INF INF 8.1 INF INF\n",
            edit=lambda text: move(text, "region tube", "pair_style"))


@pytest.mark.parametrize("kind, box", [("sq", "straight"), ("hex", "straight"), ("sq", "walls")])
@pytest.mark.parametrize("hole, message", [
    ("-4.2 -3.2 3 4", "the rows of the zone have 1 gaps; it must be filled from the plane to its end"),
    ("-1.2 0 3 4", "have 1 gaps"),
    ("-5 -2 INF INF", "have [0-9]+ gaps"),
])
def test_zone_with_a_hole(lammps, kind, box, hole, message):
    channel = Channel(kind=kind, box=box)
    refused(lammps, message, channel=channel, ranks=(2,), edit=lambda text: text.replace(
        "pair_style", f"region hole block {hole} INF INF\ngroup hole region hole\ngroup solid subtract hole in\n"
        "group hole subtract hole solid\ndelete_atoms group hole compress no\npair_style", 1).replace(" density rho0", ""))


def test_outlet_that_is_not_filled_to_its_end(lammps):
    """What flows out does not fill it."""
    refused(lammps, "the rows of the zone have 8 gaps", ranks=(2,), edit=lambda text: text.replace(
        "pair_style", "region far block 21 INF INF INF INF INF\ndelete_atoms region far compress no\npair_style", 1))


def test_zone_that_overlaps_another(lammps):
    second = "region top block INF 0 4 INF INF INF\ngroup top region top\ngroup in subtract in top\n"
    def edit(text):
        text = text.replace("pair_style", second.replace("group in subtract in top", "group low subtract in top") + "pair_style")
        return text.replace("fix in in", "fix in low").replace("fix out", "fix top top sph/open fluid 0 0 0 1 0 0 8 velocity 0.1 0 0\nfix out")
    refused(lammps, "particles of other open zones are in this one; limit it by the keyword region", edit=edit)


def test_zone_that_overlaps_a_wall(lammps):
    """A particle of a solid between those of the zone."""
    for place in ("-4.3 3.6 0", "-4.05 3.8 0"):
        refused(lammps, "overlap with others|inside a wall", edit=lambda text: text.replace(
            "pair_style", f"create_atoms 1 single {place} units box\ngroup solid id 257\nset group solid mass 1.0\npair_style").replace(
            "fix in", "fix S solid sph/wall\nfix in", 1))


def test_particles_of_another_pair_style(lammps):
    """They are not in the way of the zone."""
    channel = Channel()
    lammps(channel.text(lammps, INLET, OUTLET, velocity=lambda place: place * 0 + [U, 0, 0]).replace(
        "read_data box.data", "read_data box.data extra/atom/types 1").replace("pair_style sph/bulk", (
            "create_atoms 2 random 200 5 NULL\nset type 2 mass 1.0\npair_style hybrid sph/bulk zero 3.0")).replace(
        "pair_coeff * * ", "pair_coeff * 2 zero\npair_coeff 1 1 sph/bulk ") + "run 20\n")


def test_zone_group_with_walls(lammps):
    channel = Channel(box="walls")
    refused(lammps, "moved by fix", channel=channel, edit=lambda text: text.replace("pair_style", "group in union in wall\npair_style"))


def test_particle_on_top_of_another(lammps):
    """A row of the zone whose place at its end is taken when it moves on."""
    refused(lammps, "at -7.[0-9]* 3.5 0, where a particle enters, there is another one", edit=lambda text: text.replace(
        "pair_style", "region end block INF -7.2 3 4 INF INF\ngroup solid region end\ngroup in subtract in solid\npair_style").replace(
        "group in subtract in solid", "group inlet subtract in solid").replace("fix in in", "fix S solid sph/wall\nfix in inlet", 1)
        .replace("density rho0", ""))


def test_zone_beyond_the_box(lammps):
    refused(lammps, "the zone reaches beyond the box, where a particle enters", edit=lambda text: text.replace(
        "in sph/open fluid 0.0 0.0 0.0 1.0 0.0 0.0 8.0", "in sph/open fluid 0.0 0.0 0.0 1.0 0.0 0.0 12.0"))


def test_inflow_faster_than_the_zone_is_long(lammps):
    refused(lammps, "the zone of length 8 ran empty; build them more often or make the zone longer", ranks=(2,),
            edit=lambda text: text.replace("neighbor 0.53 bin", "neighbor 0.53 bin\nneigh_modify every 1000 delay 0 check no"),
            run="run 3000\n", before="thermo_modify lost ignore\n")


def test_particles_of_no_order(lammps):
    refused(lammps, "cannot find the distance of the particles in a row", edit=lambda text: text.replace(
        "pair_style", "displace_atoms in random 0.3 0.3 0 4711\npair_style"))


def test_type_that_is_no_fluid(lammps):
    channel = Channel()
    refused(lammps, "is not of the fluid|All pair coeffs|not set", channel=channel, edit=lambda text: text.replace(
        "read_data box.data", "read_data box.data extra/atom/types 1\nset atom 1*5 type 2").replace(
        "pair_style sph/bulk", "pair_style hybrid sph/bulk zero 3.0").replace("pair_coeff * * ", "pair_coeff * 2 zero\npair_coeff 1 1 sph/bulk "))


# ---------------------------------------------------------------------------------------------
# warnings


def test_supersonic_outflow(lammps):
    """Once, however many particles and steps there are; nothing is said where everything comes from inside."""
    for outlet, number in (("density 1.0", 1), ("density 1.0 condition characteristic", 1), ("density 1.0 condition fixed", 1),
                           ("condition fixed", 0)):
        channel = Channel()
        for ranks in (1, 4) if "characteristic" in outlet else (1,):
            result = lammps(channel.text(lammps, "velocity 1.5 0 0 density 1.0 condition fixed", outlet, timestep=0.05,
                                         velocity=lambda place: place * 0 + [1.5, 0, 0]) + "run 40\nrun 40\n", ranks=ranks)
            assert len(re.findall("WARNING.*leave faster than sound", result.log)) == number


def warned(lammps, message, channel=None, ranks=(1, 2), edit=None, times=1, run="run 2\nrun 2\n", inlet=INLET, outlet=OUTLET, **keywords):
    """So many times in two runs, once for each zone."""
    channel = channel or Channel()
    text = channel.text(lammps, inlet, outlet, **{"velocity": lambda place: place * 0 + [U, 0, 0], **keywords}) + run
    for number in ranks:
        result = lammps(edit(text) if edit else text, ranks=number)
        assert len(re.findall(message, re.sub(r"\s+", " ", result.log))) == times, result.warnings


@pytest.mark.parametrize("kind", ["sq", "hex", "hexrows"])
def test_missing_row(lammps, kind):
    channel = Channel(kind=kind, zone=9.0)
    rows = channel.place[channel.part == 0][:, 1]
    row = sorted(set(rows.round(6)))[3]
    warned(lammps, "WARNING: Fix sph/open: [0-9]+ particles of the fluid at the plane have neither the zone nor a wall behind them",
           channel=channel, edit=lambda text: text.replace(
               "pair_style", f"region row block INF 0 {row - 0.1} {row + 0.1} INF INF\ndelete_atoms region row compress no\npair_style", 1))


@pytest.mark.parametrize("factor, found", [(3.0, "3"), (1.2, r"1\.2"), (0.5, r"0\.5")])
def test_mass_that_is_not_that_of_the_density(lammps, factor, found):
    warned(lammps, f"Fix sph/open in: the masses of the zone, where its particles are, make {found}[0-9.]* times the density",
           edit=lambda text: text.replace("pair_style", f"set group in mass {factor}\npair_style", 1))


def test_masses_that_were_set_before_there_was_a_zone(lammps):
    """By a part in a thousand, which is what density rho0 changes.  Not if the zones were there: they have the factor, too."""
    warned(lammps, r"keyword density has set the masses of the fluid before; those of the zone, of type 1, differ from them by a part of",
           times=2, edit=lambda text: text.replace("fix in in", "run 0\nfix in in", 1))
    again = "".join(f"unfix {name}\nfix {name} {Channel().plane(name)} {words}\n" for name, words in (("in", INLET), ("out", OUTLET)))
    warned(lammps, "keyword density has set", times=0, run=f"run 2\n{again}run 2\n")


@pytest.mark.parametrize("styles, times", [("lj/cut 1.2 zero 1.2", 2), ("zero 1.2", 0)])
def test_forces_of_other_pair_styles(lammps, styles, times):
    """The ledger does not have them; a style without forces has none."""
    others = "".join(f"pair_coeff * * {name}{' 0.01 0.5' if name == 'lj/cut' else ''}\n" for name in styles.split()[::2])
    warned(lammps, "the impulse and the energy of the forces of pair style lj/cut between zone and fluid are not in the ledger", times=times,
           edit=lambda text: text.replace("pair_style sph/bulk", f"pair_style hybrid/overlay sph/bulk {styles}").replace(
               "pair_coeff * * ", f"{others}pair_coeff * * sph/bulk ", 1))


def test_fluid_that_tears_off(lammps):
    """It is five times as fast as what enters."""
    warned(lammps, r"Fix sph/open in: there is a gap of [0-9.]+ in the fluid in front of the particles that enter at step [0-9]+: the fluid tears off",
           velocity=lambda place: place * 0 + [[0.5, 0, 0] if s > 0 else [U, 0, 0] for s in place[:, 0]], timestep=0.1, run="run 50\nrun 50\n")


def test_no_warning_of_subsonic_flow(lammps):
    channel = Channel()
    result = lammps(channel.text(lammps, INLET, OUTLET, velocity=lambda place: place * 0 + [U, 0, 0], timestep=0.25) + "run 100\n")
    assert "WARNING" not in result.log, result.warnings
