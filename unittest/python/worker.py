"""A process that has loaded LAMMPS's library and started MPI, and runs one input after the other: a start takes most of the time of a
short run. helpers.py starts it, alone or once per rank.

    worker.py LIBRARY SOCKET

A line of JSON comes for each input: its folder, the number that its files have, and the environment variables of LAMMPS.
The answer is 0 after a run without an error, 1 after an error that all ranks have reported (the worker goes on, with LAMMPS left as it is),
2 after one of a single rank, which ends the worker.
"""

import ctypes
import json
import os
import socket
import sys


def load(path):
    library = ctypes.CDLL(path, ctypes.RTLD_GLOBAL)
    library.lammps_open_no_mpi.restype = ctypes.c_void_p
    library.lammps_file.argtypes = [ctypes.c_void_p, ctypes.c_char_p]
    library.lammps_get_last_error_message.argtypes = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int]
    library.lammps_close.argtypes = [ctypes.c_void_p]
    library.lammps_mpi_init()
    return library


def run(library, folder, number):
    """Does what the executable does; the output goes to out.NUMBER."""
    os.chdir(folder)
    output = os.open(f"out.{number}", os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o644)
    os.dup2(output, 1)
    os.dup2(output, 2)
    os.close(output)
    words = [word.encode() for word in ("lmp", "-log", f"log.{number}", "-nocite")]
    handle = library.lammps_open_no_mpi(len(words), (ctypes.c_char_p * len(words))(*words), None)
    library.lammps_file(handle, f"in.{number}".encode())
    status = library.lammps_get_last_error_message(handle, ctypes.create_string_buffer(1), 1)
    if not status:
        library.lammps_close(handle)
    ctypes.CDLL(None).fflush(None)
    return status


def main(path, address):
    library = load(path)
    with socket.socket(socket.AF_UNIX) as connection:
        connection.connect(address)
        for line in connection.makefile():
            folder, number, variables = json.loads(line)
            for name in [name for name in os.environ if name.startswith("LAMMPS_")]:
                del os.environ[name]
            os.environ.update(variables)
            status = run(library, folder, number)
            connection.sendall(f"{status}\n".encode())
            if status == 2:
                os._exit(1)
    library.lammps_mpi_finalize()


if __name__ == "__main__":
    main(*sys.argv[1:])
