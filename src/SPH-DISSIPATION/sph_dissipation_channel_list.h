/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

// The list of the channels, in the order of compute sph/dissipation: one line for each header.  sph_dissipation_channels.h
// includes this list for each part of the headers.

// clang-format off
#include "sph_dissipation_channel_shear.h"
#include "sph_dissipation_channel_bulk.h"
#include "sph_dissipation_channel_vortex.h"
#include "sph_dissipation_channel_spin.h"
#include "sph_dissipation_channel_drag.h"
#include "sph_dissipation_channel_relax.h"
#include "sph_dissipation_channel_interdrag.h"
#include "sph_dissipation_channel_heat.h"
#include "sph_dissipation_channel_solute.h"
#include "sph_dissipation_channel_thixotropy.h"
#include "sph_dissipation_channel_tension.h"
// clang-format on
