"""Coefficients over time: what pair_coeff overwrites, what fix adapt varies, what restart files keep."""

import re
import struct

import numpy as np
import pytest

import test_micropolar
import test_relax as relax
from helpers import INTEGRATE, as_written, disordered, dump, fluid, header, relative, undump

LIKE = {1: "1.0 10.0 0.5 2.0 3.0", 2: "1.1 12.0 0.2 0.8 3.0"}
COLUMN = {"mu": 2, "kappa": 3, "c0": 1}


def coeffs(**changes):
    """pair_coeff lines of two types; mu=(0.4, 0.3) changes mu of both, pb adds a keyword."""
    lines = ""
    for i, text in LIKE.items():
        words = text.split()
        for name, values in changes.items():
            if name == "pb":
                words += ["pb", repr(values[i - 1])]
            else:
                words[COLUMN[name]] = repr(values[i - 1])
        lines += f"pair_coeff {i} {i} {' '.join(words)}\n"
    return lines


def start(lammps, lines, options="", before="", cells=12):
    disordered(2, cells, ntypes=2).write(lammps.path("box.data"))
    return (header(2) + f"pair_style sph/bulk {options}\nread_data box.data\n" + lines + before + INTEGRATE)


def forces(lammps, text, name="f.dump", ranks=1, steps=0):
    lammps(text + dump(name) + f"run {steps}\n", ranks=ranks)
    return lammps.frame(name)["f"]


# ---------------------------------------------------------------------------------------------
# back to the mean


@pytest.mark.parametrize("back", [
    "pair_coeff * * 1.0 10.0 0.5 2.0 3.0\n" + coeffs(),
    "pair_coeff 1*2 * 1.0 10.0 0.5 2.0 3.0\n" + coeffs(),
    "pair_coeff 1 2 mu mean\n", "pair_coeff 2 1 mu mean\n", "pair_coeff * * mu mean\n",
    "pair_style none\npair_style sph/bulk\n" + coeffs()])
def test_back_to_the_mean(lammps, back):
    mean = forces(lammps, start(lammps, coeffs()))
    again = forces(lammps, start(lammps, coeffs() + "pair_coeff 1 2 mu 0.9\n" + back))
    assert relative(again - mean, mean) == 0.0


@pytest.mark.parametrize("keep", ["pair_coeff 1 1 1.0 10.0 0.5 2.0 3.0\n", "pair_style sph/bulk\n",
                                  "pair_coeff 1 * 1.0 10.0 0.5 2.0 3.0\n"])
def test_what_leaves_a_viscosity_between_types_alone(lammps, keep):
    """One type anew, and a repeated pair_style, which in LAMMPS keeps all of pair_coeff."""
    own = forces(lammps, start(lammps, coeffs() + "pair_coeff 1 2 mu 0.9\n"))
    again = forces(lammps, start(lammps, coeffs() + "pair_coeff 1 2 mu 0.9\n" + keep))
    assert relative(again - own, own) == 0.0


def test_one_of_several_viscosities_back_to_the_mean(lammps):
    particles = disordered(2, 10, ntypes=2)
    test_micropolar.write(particles, lammps.path("box.data"))
    texts = {"mean": "", "own": "pair_coeff 1 2 mu 0.1 mu_r 0.05\n",
             "mu back": "pair_coeff 1 2 mu 0.1 mu_r 0.05\npair_coeff 1 2 mu mean\n", "mu_r": "pair_coeff 1 2 mu_r 0.05\n"}
    found = {}
    for name, lines in texts.items():
        model = test_micropolar.two_fluids(2).splitlines(keepends=True)
        lammps(header(2, style="sph/micropolar") + model[0] + "read_data box.data\n" + "".join(model[1:3]) + lines
               + test_micropolar.integrate() + test_micropolar.dump("f.dump") + "run 0\n")
        found[name] = lammps.frame("f.dump")["f"]
    assert relative(found["mu back"] - found["mu_r"], found["mean"]) == 0.0
    assert relative(found["mu back"] - found["own"], found["mean"]) > 1e-4


# ---------------------------------------------------------------------------------------------
# fix adapt


def adapt(*settings, every=1, pair="sph/bulk", extra=""):
    """fix adapt of (name, types, formula)."""
    text = "".join(f"variable a{k} equal \"{formula}\"\n" for k, (_, _, formula) in enumerate(settings))
    words = " ".join(f"pair {pair} {name} {types} v_a{k}" for k, (name, types, _) in enumerate(settings))
    return text + f"fix A all adapt {every} {words} {extra}\n"


@pytest.mark.parametrize("ranks", [1, 2, 4])
@pytest.mark.parametrize("name, values", [("mu", (0.8, 0.3)), ("kappa", (0.4, 3.0)), ("c0", (8.0, 14.0)), ("pb", (1.5, 0.5))])
def test_adapt_is_pair_coeff(lammps, name, values, ranks):
    """Values of each type; the viscosity of the unlike pair follows them."""
    settings = [(name, f"{i} {i}", repr(value)) for i, value in enumerate(values, 1)]
    want = forces(lammps, start(lammps, coeffs(**{name: values})), ranks=ranks, steps=20)
    text = start(lammps, coeffs(), before=adapt(*settings))
    have = forces(lammps, text, ranks=ranks, steps=20)
    assert relative(have - want, want) < 1e-12
    assert relative(forces(lammps, start(lammps, coeffs()), steps=20) - want, want) > 1e-4


@pytest.mark.parametrize("pair_style", ["sph/bulk", "hybrid/overlay sph/bulk zero 3.0"])
def test_adapt_of_all_types_and_of_an_unlike_pair(lammps, pair_style):
    lines = coeffs() + "pair_coeff 1 2 mu 0.9\n"
    want = forces(lammps, start(lammps, coeffs(mu=(0.7, 0.7)) + "pair_coeff 1 2 mu 0.7\n"), steps=10)
    text = start(lammps, lines, before=adapt(("mu", "* *", "0.7")))
    if pair_style != "sph/bulk":
        text = text.replace("pair_style sph/bulk", f"pair_style {pair_style}")
        text = re.sub(r"pair_coeff (\d) (\d)", r"pair_coeff \1 \2 sph/bulk", text)
        text = text.replace("fix A", "pair_coeff * * zero\nfix A")
    assert relative(forces(lammps, text, steps=10) - want, want) < 1e-12
    want = forces(lammps, start(lammps, coeffs() + "pair_coeff 1 2 mu 0.1\n"), steps=10)
    have = forces(lammps, start(lammps, lines, before=adapt(("mu", "1 2", "0.1"))), steps=10)
    assert relative(have - want, want) < 1e-12


@pytest.mark.parametrize("ours", [1, 2])
def test_adapt_in_hybrid_whichever_type_is_the_fluid(lammps, ours):
    """Also after a run, and before pair_coeff, which comes last and counts."""
    other = 3 - ours
    pair = "hybrid zero 3.0 sph/bulk"
    lines = f"pair_coeff {other} {other} zero\npair_coeff 1 2 zero\npair_coeff {ours} {ours} sph/bulk 1.0 10.0 {{}} 2.0 3.0\n"

    def text(mu, before=""):
        return start(lammps, lines.format(mu), before=before).replace("pair_style sph/bulk", f"pair_style {pair}")

    change = adapt(("mu", f"{ours} {ours}", "0.9"))
    want = forces(lammps, text(0.9), steps=10)
    have = forces(lammps, text(0.5, change), steps=10)
    assert relative(have - want, want) < 1e-12
    assert relative(forces(lammps, text(0.5), steps=10) - want, want) > 1e-4
    again = adapt(("mu", f"{ours} {ours}", "0.9"), extra="reset yes")
    want = forces(lammps, text(0.5, again) + "run 10\nunfix A\n" + lines.format(0.7))
    have = forces(lammps, text(0.5, again) + "run 10\nunfix A\nrun 0\n" + lines.format(0.7))
    assert relative(have - want, want) == 0.0


def test_adapt_of_the_mean_with_both_types(lammps):
    """Ranges that cover both types, and factors, change a mixed pair to what it would be anyway."""
    want = forces(lammps, start(lammps, coeffs(mu=(0.7, 0.7), kappa=(1.0, 1.0))))
    have = forces(lammps, start(lammps, coeffs(), before=adapt(("mu", "* *", "0.7"), ("kappa", "1*2 1*2", "1.0"))))
    assert relative(have - want, want) < 1e-13
    want = forces(lammps, start(lammps, coeffs(mu=(1.0, 0.4), kappa=(4.0, 1.6))))
    have = forces(lammps, start(lammps, coeffs(), before=adapt(("mu", "* *", "2.0"), ("kappa", "* *", "2.0"), extra="scale yes")))
    assert relative(have - want, want) < 1e-13


def test_adapt_in_time(lammps):
    """Forces are linear in mu and kappa: a step up and a step down in step 5 change the force of that step by
    opposite amounts, and nothing before."""
    frames = {}
    for name, step in {"up": 0.3, "no": 0.0, "down": -0.3}.items():
        formula = f"0.5+{step}*(step>=5)"
        text = start(lammps, coeffs(mu=(0.5, 0.5)), before=adapt(("mu", "* *", formula), ("kappa", "1 1", f"1.5+{formula}")))
        lammps(text + dump("f.dump") + "thermo 1\nrun 6\n")
        frames[name] = lammps.frames("f.dump")
    up, no, down = frames["up"], frames["no"], frames["down"]
    for step in range(5):
        assert (up[step]["f"] == no[step]["f"]).all()
    change = up[5]["f"] - no[5]["f"]
    assert relative(change, no[5]["f"]) > 1e-3
    assert relative(change + (down[5]["f"] - no[5]["f"]), change) < 1e-11


@pytest.mark.parametrize("reset", [False, True])
def test_adapt_leaves_the_last_values_or_the_first(lammps, reset):
    """Also in the files, and when pair_coeff follows; the table is printed for new values only."""
    text = start(lammps, coeffs(), before=adapt(("mu", "1 1", "0.5+0.01*step"), ("c0", "2 2", "12-0.1*step"), every=10,
                                                extra="reset yes" if reset else ""))
    result = lammps(text + "run 30\nunfix A\nwrite_data out.data pair ii nocoeff\nwrite_restart out.restart\n"
                    "write_coeff out.coeff\npair_coeff 2 2 1.1 12.0 0.25 0.8 3.0\n" + dump("f.dump") + "run 0\n")
    written = lammps.path("out.coeff").read_text()
    first = re.search(r"^pair_coeff +1 +1 (.*)$", written, re.MULTILINE)[1].split()
    second = re.search(r"^pair_coeff +2 +2 (.*)$", written, re.MULTILINE)[1].split()
    assert float(first[2]) == pytest.approx(0.5 if reset else 0.8, rel=1e-15)
    assert float(second[1]) == pytest.approx(12.0 if reset else 9.0, rel=1e-15)
    mu = re.findall(r"^ +1-1 +(\S+)", result.log, re.MULTILINE)
    assert 2 <= len(mu) <= 3 and float(mu[-1]) == float(first[2]), mu
    mu = re.findall(r"^ +2-2 +(\S+)", result.log, re.MULTILINE)
    assert float(mu[-1]) == 0.25
    result = lammps("read_restart out.restart\n" + INTEGRATE + "run 0\n")
    assert float(re.search(r"^ +1-1 +(\S+)", result.log, re.MULTILINE)[1]) == float(first[2])


@pytest.mark.parametrize("settings, options, words", [
    ([("mu", "1 2", "0.3")], "", "mu of types 1 2 was changed to 0.3, but it is the mean"),
    ([("mu", "1 *", "0.3")], "", "mu of types 1 2 .* pair_coeff first"),
    ([("kappa", "1 2", "3.0")], "", "kappa of types 1 2 .* belongs to a type"),
    ([("c0", "1 *", "9.0")], "", "c0 of types 1 2 .* belongs to a type"),
    ([("mu", "1 1", "-0.3")], "", "mu of types 1 1 was changed to -0.3, which is not admissible"),
    ([("c0", "* *", "1-step")], "", "c0 of types 1 1 was changed to 0"),
    ([("kappa", "* *", "3.0")], "bulk none", "kappa not supported"),
    ([("mu", "* *", "3.0")], "shear none", "mu not supported"),
    ([("c0", "* *", "3.0")], "eos ideal", "c0 not supported"),
    ([("rc", "* *", "3.0")], "", "rc not supported"),
    ([("mu_r", "* *", "3.0")], "", "mu_r not supported")])
def test_adapt_refused(lammps, settings, options, words):
    text = start(lammps, coeffs(mu=(0.0, 0.0)) if options == "shear none" else coeffs(), options, adapt(*settings))
    result = lammps(text + "run 3\n", check=False)
    assert result.code == 1
    assert re.search(words, result.error), result.error


def test_adapt_of_intrinsic_kappa(lammps):
    """It follows mu, and cannot be set."""
    lines = "pair_coeff * * 1.0 10.0 {} intrinsic 3.0\n"
    want = forces(lammps, start(lammps, lines.format(0.7)))
    have = forces(lammps, start(lammps, lines.format(0.5), before=adapt(("mu", "* *", "0.7"))))
    assert relative(have - want, want) < 1e-13
    result = lammps(start(lammps, lines.format(0.5), before=adapt(("kappa", "* *", "2.0"))) + "run 0\n", check=False)
    assert re.search("kappa of type 1 is intrinsic", result.error), result.error


@pytest.mark.parametrize("dim", [2, 3])
def test_adapt_micropolar(lammps, dim):
    particles = disordered(dim, 10 if dim == 2 else 6)
    test_micropolar.write(particles, lammps.path("box.data"))

    def evaluate(name, model, before=""):
        head = header(dim, style="sph/micropolar")
        lammps(head + "read_data box.data\n" + model + before + test_micropolar.integrate()
               + test_micropolar.dump(name) + "run 5\n")
        frame = lammps.frame(name)
        return np.hstack([frame["f"], np.column_stack([frame[word] for word in ("tqx", "tqy", "tqz")])])

    gamma1, gamma2 = test_micropolar.gammas(dim, 0.11).split()
    settings = [("mu", "* *", "0.6"), ("mu_r", "* *", "0.4"), ("gamma1", "* *", gamma1), ("gamma2", "* *", gamma2)]
    want = evaluate("want.dump", test_micropolar.fluid(dim, mu=0.6, mu_r=0.4, gamma1=0.11))
    have = evaluate("have.dump", test_micropolar.fluid(dim), adapt(*settings, pair="sph/micropolar"))
    assert relative(have - want, want) < 1e-12
    result = lammps(header(dim, style="sph/micropolar") + "read_data box.data\n" + test_micropolar.fluid(dim)
                    + adapt(("mu_r", "* *", "5.0"), pair="sph/micropolar") + test_micropolar.integrate() + "run 0\n",
                    check=False)
    assert re.search("mu_r must be <= mu", result.error), result.error
    result = lammps(header(dim, style="sph/micropolar") + "read_data box.data\n" + test_micropolar.fluid(dim, mu_r=0.0, gamma1=0.0)
                    + adapt(("mu_r", "* *", "0.1*step"), pair="sph/micropolar") + test_micropolar.integrate() + "run 0\n",
                    check=False)
    assert re.search("mu_r not supported", result.error), result.error


# ---------------------------------------------------------------------------------------------
# files


def test_heat_capacity_stays_with_its_type(lammps):
    """Data files have it with and without temp energy."""
    pair = "pair_style sph/bulk {}\n"
    text = start(lammps, coeffs().replace("3.0\n", "3.0 cv 20.0\n"), "temp energy 10.0 5")
    lammps(text + "set group all sph/e 1.0\nwrite_data with.data\n" + pair.format("") + "write_data out.data\n")
    lammps(header(2) + pair.format("") + "read_data out.data\n" + INTEGRATE + "run 0\nwrite_data again.data\n")
    for name in ("with", "out", "again"):
        assert lammps.path(f"{name}.data").read_text().count("cv 20") == 2


READ = 254  # characters of a line that read_data takes


def number(random):
    """One with as many digits as there are."""
    return repr(float(random.uniform(0.1, 0.9) * 10.0 ** -random.integers(4, 6)))


@pytest.mark.parametrize("style, eos", [("sph/bulk", "tait"), ("sph/bulk", "ideal"), ("sph/micropolar", "linear")])
def test_data_file_has_all_keywords(lammps, style, eos):
    """Each keyword at its maximum comes back bit for bit, or write_data says that the line is too long; nothing is cut."""
    random = np.random.default_rng(7)
    box = "region box block 0 6 0 6 -0.5 0.5\ncreate_box 2 box\ncreate_atoms 1 single 1 1 0\nset group all mass 1.0 sph/e 1.0\n"
    fix = f"fix 1 all {style}\n"
    found = {"back": 0, "refused": 0}
    for count in (0, 1, 4, 8):
        for digits in ("few", "many"):
            n = (lambda: number(random)) if digits == "many" else (lambda: repr(round(float(random.uniform(0.1, 0.9)), 2)))
            spins = "0.0 0.0 0.0 " if style == "sph/micropolar" else ""
            words = f"1.1 10.3 {n()} {n()} {spins}3.3 gamma {'1.6' if eos == 'ideal' else '4.1'} pb {n()} cv {n()} drag {n()} {n()} {n()} 0 conductivity {n()}"
            words += f" gruneisen 1e-3 {n()}" if eos != "ideal" else f" vibration {n()} {n()}" if count < 8 else ""
            words += "".join(f" relax {n()} {n()}" for _ in range(count))
            first = header(2, style=f"{style} relax 8")
            pair = f"pair_style {style} eos {eos}\n"
            text = first + box + pair + f"pair_coeff * * {words}\npair_coeff 1 2 mu {n()}\n" + fix
            for pairs in ("ii", "ij"):
                result = lammps(text + f"write_data out.data pair {pairs}\n", check=False)
                if result.code:
                    assert "read_data takes 254; use write_restart" in result.error and digits == "many"
                    found["refused"] += 1
                    continue
                assert max(map(len, lammps.path("out.data").read_text().splitlines())) <= READ
                lammps(first + pair + f"read_data out.data\n" + fix + f"write_data again.data pair {pairs}\n")
                sections = [lammps.path(f"{name}.data").read_text().split("Coeffs")[1] for name in ("out", "again")]
                assert sections[0] == sections[1]
                given = sorted(float(word) for word in words.split() if re.match(r"[-\d.]", word) and float(word) != 0.0)
                line = sections[0].splitlines()[2].split()[1 if pairs == "ii" else 2:]
                kept = sorted(float(word) for word in line if re.match(r"[-\d.]", word) and float(word) != 0.0)
                assert kept == given, line
                found["back"] += 1
    assert found["back"] >= 8 and found["refused"] > 2


@pytest.mark.parametrize("hybrid", [False, True])
def test_data_file_has_all_states(lammps, hybrid):
    """The states of eight processes come back, or write_data says that a line is too long."""
    sub = "hybrid sph/bulk relax 8 charge" if hybrid else "sph/bulk relax 8"
    first = header(2, style=sub)
    pair = "pair_style sph/bulk\npair_coeff * * 1.0 10.0 0.5 2.0 3.0 " + " ".join(f"relax {k}.0 {k}.5" for k in range(1, 9)) + "\n"
    names = [f"d_rho_relaxed{k}" for k in range(1, 9)]
    place = "region box block 0 4 0 4 -0.5 0.5\ncreate_box 1 box\ncreate_atoms 1 single {0} 0.2 0\ncreate_atoms 1 single {0} 3.1 0\n"
    for state, x in (("1.25", "0.5"), ("1.0023456789012345", "0.5"), ("1.234567890123456e-105", "0.1234567890123456")):
        lines = f"set group all mass {state} sph/e {state}\n" + "".join(f"set group all {name} {state}\n" for name in names)
        result = lammps(first + place.format(x) + ("mass * 1.0\n" if hybrid else "") + pair + lines + "fix 1 all sph/bulk\nwrite_data out.data nocoeff\n", check=False)
        if "e" in state and result.code:
            assert re.search(r"the line of atom \d has \d+ characters, and read_data takes 254, .* its states", result.error)
            continue
        lammps(first + "read_data out.data\n" + pair + f"write_dump all custom back.dump id {' '.join(names)} modify format float %.17g\n")
        back = lammps.frame("back.dump")
        assert all((back[name] == as_written(float(state))).all() for name in names)
    assert result.code


# ---------------------------------------------------------------------------------------------
# damaged restart files


def restart_file(lammps):
    lammps(start(lammps, coeffs()) + "write_restart good.restart\n")
    data = lammps.path("good.restart").read_bytes()
    number = struct.pack("<d", 1.1)  # rho0 of type 2
    assert data.count(number + struct.pack("<d", 12.0)) == 1
    return data, data.index(number)


def test_restart_file_with_a_number_that_no_fluid_has(lammps):
    data, place = restart_file(lammps)
    for value in (-1.0, float("nan")):
        lammps.path("bad.restart").write_bytes(data[:place] + struct.pack("<d", value) + data[place + 8:])
        for ranks in (1, 2):
            result = lammps("read_restart bad.restart\n", ranks=ranks, check=False)
            assert result.code != 0 and re.search("Restart file is damaged: pair style sph/bulk rho0 is", result.error)


def test_restart_file_with_other_settings(lammps):
    """Settings as the versions before wrote them, of a version to come, and nonsense."""
    data, _ = restart_file(lammps)
    first = struct.pack("<6i", 0, 0, 1, 1, 0, 0)
    formats = [struct.unpack("<i", before)[0] for before in re.findall(rb"(?s)(.{4})" + re.escape(first), data)]
    form, = (one for one in formats if one % 65536 == 1008)  # the upper bits follow from the names of coefficients
    head = struct.pack("<i", form) + first
    assert data.count(head) == 1
    for new, words in {struct.pack("<7i", 0, 0, 1, 1, 0, 0, 1): "written by an older version of pair style sph/bulk",
                       struct.pack("<7i", form - 1, 0, 0, 1, 1, 0, 0): "written by an older version",
                       struct.pack("<7i", form + 1, 0, 0, 1, 1, 0, 0): "written by a newer version",
                       struct.pack("<7i", form, 17, 0, 1, 1, 0, 0): "damaged: pair style sph/bulk kernel is 17",
                       struct.pack("<7i", form, 0, 0, 5, 1, 0, 0): "damaged: pair style sph/bulk has no such shear form"}.items():
        lammps.path("bad.restart").write_bytes(data.replace(head, new))
        result = lammps("read_restart bad.restart\n", check=False)
        assert result.code != 0 and re.search(words, result.error), result.error or result.output[-2000:]


def test_restart_file_that_ends_too_early(lammps):
    data, place = restart_file(lammps)
    lammps.path("bad.restart").write_bytes(data[:place + 11])
    result = lammps("read_restart bad.restart\n", check=False)
    assert result.code != 0 and re.search("[Uu]nexpected end of file|Incomplete or corrupted", result.error), result.error


# ---------------------------------------------------------------------------------------------
# words


@pytest.mark.parametrize("line, message", [
    ("conductivity 1 conductivity 0", "Pair_coeff keyword conductivity is given twice"), ("pb 1 pb 2", "Pair_coeff keyword pb is given twice"),
    ("relax inf 1", "parameter instead of 'inf'"), ("relax 1 nan", "parameter instead of 'nan'")])
def test_keywords_that_are_refused(lammps, line, message):
    result = lammps(start(lammps, f"pair_coeff * * 1 10 0.5 2 3 cv 1 {line}\n"), check=False)
    assert result.code and message in result.error, result.error


@pytest.mark.parametrize("line", ["mu 0.1 mu 0.2", "interdrag 1 mu 0.1 interdrag 1"])
def test_keywords_of_unlike_types_come_once(lammps, line):
    disordered(2, 8, ntypes=2).write(lammps.path("two.data"))
    result = lammps(header(2) + "read_data two.data\n" + fluid(2) + f"pair_coeff 1 2 {line}\n", check=False)
    assert result.code == 1 and f"Pair_coeff keyword {line.split()[0]} is given twice" in result.error, result.error


@pytest.mark.parametrize("line, warning", [("drag 0 1 1 0", "the stream of drag 0 of type 1 is ignored"), ("gruneisen 0 300", "T0 of gruneisen 0 of type 1 is ignored")])
def test_keywords_without_effect(lammps, line, warning):
    assert warning in lammps(start(lammps, f"pair_coeff * * 1 10 0.5 2 3 cv 1 {line}\n") + "run 0\n").output


def test_a_process_that_is_not_there_cannot_be_varied(lammps):
    text = start(lammps, "pair_coeff * * 1 10 0.5 2 3 relax 1 1 relax 2 1\n").replace("atom_style sph/bulk", "atom_style sph/bulk relax 3")
    relax.write(disordered(2, 12, ntypes=2), lammps.path("box.data"), np.zeros((144, 3)))
    result = lammps(text + "variable one equal 0.7\nfix A all adapt 1 pair sph/bulk kappa_r3 1 1 v_one\nrun 1\n", check=False)
    assert result.code and "kappa_r3 of type 1 cannot be changed: its pair_coeff does not have it" in result.error, result.error


def test_repeated_coefficients_are_no_change(lammps):
    """A restart file, then the commands that it has already."""
    pair = "pair_style sph/bulk temp 0.01 4711\n" + coeffs() + "pair_coeff 1 2 mu 0.9\n"
    disordered(2, 12, ntypes=2).write(lammps.path("box.data"))
    more = "fix FLUID all sph/bulk viscous implicit tolerance 1e-12\ntimestep 0.005\n"
    text = pair.replace("\npair_coeff", "\nread_data box.data\npair_coeff", 1)
    lammps(header(2) + text + more + "run 10\nwrite_restart state.restart\nrun 10\n" + dump("whole.dump") + "run 0\n")
    ends = []
    for k, lines in enumerate(("", pair, pair + "pair_coeff 1 1 1.0 10.0 0.5 2.0 3.0\npair_coeff 1 2 mu 0.9\n")):
        lammps("read_restart state.restart\n" + lines + more + "run 10\n" + dump(f"{k}.dump") + "run 0\n")
        ends.append(lammps.frame(f"{k}.dump"))
        assert relative(ends[k]["v"] - ends[0]["v"], ends[0]["v"]) == 0.0
        assert relative(ends[k]["x"] - lammps.frame("whole.dump")["x"], ends[0]["x"]) < 1e-10
