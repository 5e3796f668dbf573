"""Let pages written for the LAMMPS manual build on their own.

* the code-block language ``LAMMPS`` gets a small lexer,
* ``:doc:`` links to pages of the LAMMPS manual become links to its public web site,
* ``versionadded:: TBD``, which LAMMPS's maintainers replace by a release, is left out,
* the number of an equation of another page, each of which counts its own, gets the last word of that page's name: (3, heat).
"""

from docutils import nodes
from pygments.lexer import RegexLexer, bygroups
from pygments.token import Comment, Keyword, Name, Number, String, Text
from sphinx import addnodes

MANUAL = "https://docs.lammps.org/"

# the pages of the LAMMPS manual that may be linked to: a misspelled name stays a warning
MANUAL_PAGES = frozenset("""
    Build_package Howto_2d Howto_grid Howto_output Howto_triclinic Howto_viscosity Modify_style
    atom_modify atom_style balance bond_style boundary comm_modify comm_style compute compute_ke compute_msd compute_pair compute_pe_atom
    compute_property_grid
    compute_pressure compute_property_atom compute_stress_atom compute_temp create_atoms dimension dump
    fix fix_adapt fix_addforce fix_ave_correlate fix_ave_grid fix_ave_time fix_balance fix_deform fix_deposit fix_dt_reset fix_langevin fix_modify fix_move fix_nve fix_rigid fix_setforce fix_sph fix_sph_stationary fix_spring fix_wall_reflect lattice mass
    minimize neigh_modify neighbor newton pair_coeff pair_hybrid pair_modify pair_sph_idealgas
    pair_sph_rhosum pair_sph_taitwater pair_sph_taitwater_morris pair_style pair_write
    plugin read_data read_restart replicate rerun reset_timestep restart run run_style set special_bonds thermo_style timer timestep
    units velocity write_data write_restart
""".split())


class LAMMPSLexer(RegexLexer):
    """LAMMPS input scripts: command, comment, variable, string and number."""

    name = "LAMMPS"
    aliases = ["LAMMPS"]

    tokens = {
        "root": [
            (r"#.*$", Comment),
            (r"^(\s*)([A-Za-z][\w/]*)", bygroups(Text, Keyword)),
            (r'"[^"\n]*"|\'[^\'\n]*\'', String),
            (r"\$\{[^}\n]*\}|\$\w|\$\([^\n]*?\)|\bv_\w+", Name.Variable),
            (r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?=\s|$)", Number),
            (r"[^\s#$\"']+", Text),
            (r"\s+|.", Text),
        ],
    }


def link_to_manual(app, env, node, contnode):
    """Resolve a :doc: reference that is no page of this documentation."""
    if node.get("reftype") != "doc" or node.get("reftarget") not in MANUAL_PAGES:
        return None
    title = contnode.astext()
    return nodes.reference("", title, internal=False,
                           refuri=f"{MANUAL}{node['reftarget']}.html",
                           reftitle="LAMMPS manual")


def remove_versions(app, doctree):
    for node in list(doctree.findall(addnodes.versionmodified)):
        if node["version"] == "TBD":
            node.parent.remove(node)


def name_pages_of_equations(app, doctree, docname):
    pages = {label.lower(): page for label, (page, _) in app.env.get_domain("math").equations.items()}
    for node in doctree.findall(nodes.reference):
        page, _, place = node.get("refuri", "").partition("#equation-")
        if place and page:
            word = pages[place.lower()].rpartition("_")[2]
            node.replace(node[0], nodes.Text(node.astext().replace(")", f", {word})")))


def setup(app):
    app.add_lexer("LAMMPS", LAMMPSLexer)
    app.connect("missing-reference", link_to_manual)
    app.connect("doctree-read", remove_versions)
    app.connect("doctree-resolved", name_pages_of_equations)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
