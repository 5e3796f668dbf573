# Install/Uninstall package files in LAMMPS
# mode = 0/1/2 for uninstall/install/update

mode=$1

# enforce using portable C locale
LC_ALL=C
export LC_ALL

# the package needs no other package: all of its files, always
# compute sph/spectrum has the FFTs of package KSPACE if that is installed: compile anew where this is looked up

for file in *.cpp *.h; do
  if (test $mode = 0) then
    rm -f ../$file
  elif (! cmp -s $file ../$file) then
    cp $file ..
    if (test $mode = 2) then
      echo "  updating src/$file"
    fi
  fi
done

if (test $mode != 0) then
  touch ../sph_dissipation_fft.cpp
fi
