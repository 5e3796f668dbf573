#!/bin/sh
# Compiler launcher: ccache.sh FOLDER COMPILER ARG... A precompiled header, of 62 MB, gets a file with its sum, which ccache takes in its
# place for each object that includes it. The sum changes with compiler, flags, and headers, as the header does.
export CCACHE_DIR="$1" CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_PCH_EXTSUM=1
shift
for word; do
  case $word in
    *.gch)
      rm -f "$word" "$word.sum"    # else the old one is included in the new one
      ccache "$@" && sha256sum <"$word" >"$word.sum"
      exit
      ;;
  esac
done
exec ccache "$@"
