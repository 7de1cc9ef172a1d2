"""Times Intel's PARDISO (mtype 2, one thread) on a matrix written by the performance program.

Usage: pardiso.py FILE TIMES. The file holds, little-endian: the number of equations and of entries (8-byte integers), row
pointers, columns of the upper triangle by rows and an order of the equations (4-byte integers, from 1), and values (8-byte
floats). Prints medians of analysis, factorisation and solution (ms) with the fastest of three orders, the name of that
order, and the relative residual.
"""

import ctypes
import statistics
import sys
import time

import numpy as np
from pypardiso import PyPardisoSolver

REORDER, NUMERIC, SOLVE, RELEASE = 11, 22, 33, -1


class Upper:
    """The part of a sparse matrix that the interface asks for."""

    def __init__(self, path):
        with open(path, "rb") as file:
            n, entries = np.fromfile(file, "<i8", 2)
            self.indptr = np.fromfile(file, "<i4", n + 1)
            self.indices = np.fromfile(file, "<i4", entries)
            self.order = np.fromfile(file, "<i4", n)
            self.data = np.fromfile(file, "<f8", entries)

    def times(self, x):
        """Product of the whole symmetric matrix and a vector."""
        rows = np.repeat(np.arange(len(x)), np.diff(self.indptr))
        columns = self.indices - 1
        apart = np.where(rows == columns, 0.0, self.data)
        return np.bincount(rows, self.data * x[columns], len(x)) + np.bincount(columns, apart * x[rows], len(x))


def call(solver, phase, matrix, b):
    """One phase of the library, without the interface's copies of the matrix."""
    as_int = lambda a: a.ctypes.data_as(ctypes.POINTER(ctypes.c_int32))
    integer = lambda value: ctypes.byref(ctypes.c_int32(value))
    x, error = np.zeros_like(b), ctypes.c_int32(0)
    solver._mkl_pardiso(
        solver.pt.ctypes.data_as(ctypes.POINTER(solver._pt_type[0])),
        integer(1), integer(1), integer(2), integer(phase), integer(len(b)),
        matrix.data.ctypes.data_as(ctypes.c_void_p), as_int(matrix.indptr), as_int(matrix.indices),
        as_int(solver.perm), integer(1), as_int(solver.iparm), integer(0),
        b.ctypes.data_as(ctypes.c_void_p), x.ctypes.data_as(ctypes.c_void_p), ctypes.byref(error),
    )
    if error.value:
        sys.exit(f"PARDISO: error {error.value} in phase {phase}")
    return x


def measure(matrix, b, times, reorder):
    """Medians of the three phases (ms) and the solution; in the order of the file if `reorder` is none."""
    solver = PyPardisoSolver(mtype=2)
    solver.iparm[0] = 1  # what follows, not the defaults
    solver.iparm[1] = reorder or 0
    solver.iparm[4] = int(reorder is None)
    solver.perm = matrix.order
    medians = []
    for phase in (REORDER, NUMERIC, SOLVE):
        spent = []
        for _ in range(times):
            begin = time.perf_counter()
            x = call(solver, phase, matrix, b)
            spent.append(1e3 * (time.perf_counter() - begin))
        medians.append(statistics.median(spent))
    call(solver, RELEASE, matrix, b)
    return medians, x


def main():
    matrix, times = Upper(sys.argv[1]), int(sys.argv[2])
    b = np.sin(np.arange(len(matrix.order), dtype=float))
    found = []
    for name, reorder in (("METIS", 2), ("minimum-degree", 0), ("along", None)):
        medians, x = measure(matrix, b, times, reorder)
        residual = np.linalg.norm(matrix.times(x) - b) / np.linalg.norm(b)
        found.append((medians[1], *medians, name, residual))
    print(*min(found)[1:])


main()
