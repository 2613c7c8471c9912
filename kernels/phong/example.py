"""The modified Phong model in a program of one's own: mean weight of example.cl beside the reflectivity.

Needs numpy and pyopencl. The exit status is 1 if a mean is off by 5 standard errors (by chance in 1 of 200,000 runs).
"""
import math
import pathlib
import sys

import numpy as np
import pyopencl as cl

INTERVALS = 1024  # of a row of the table
WORK_ITEMS, SAMPLES = 4096, 1024  # of one lane each: WIDTH is 1
NODES, WEIGHTS = np.polynomial.legendre.leggauss(64)


def reflectivity(n, cosine):
    """rho_s / ks by (3) of sampling.md, with its incomplete beta function as an integral of (1 - y^2)^(n / 2)."""
    partial = cosine / 2 * WEIGHTS @ np.exp(n / 2 * np.log1p(-((cosine / 2 * (1 + NODES)) ** 2)))
    whole = math.sqrt(math.pi) * math.exp(math.lgamma(n / 2 + 1) - math.lgamma((n + 3) / 2))
    grazing = math.exp(math.lgamma((n + 1) / 2) - math.lgamma(n / 2 + 1)) / (2 * math.sqrt(math.pi))
    return cosine * (0.5 + partial / whole) + grazing * (1 - cosine**2) ** (n / 2 + 1)


def main():
    kernels = pathlib.Path(__file__).resolve().parent.parent
    context = cl.create_some_context(interactive=False)
    queue = cl.CommandQueue(context)
    source = f"""
#define WIDTH 1
#define PHONG_TABLE_INTERVALS {INTERVALS}
#define PHONG_STRATEGY "phong/strategies/exact.cl"
#include "phong/example.cl"
"""
    kernel = cl.Program(context, source).build(["-I", str(kernels)]).mean_weight
    means = np.empty(WORK_ITEMS, np.float32)
    result = cl.Buffer(context, cl.mem_flags.WRITE_ONLY, means.nbytes)
    wrong = 0
    for kd, ks, n, degrees in [(0.4, 0.4, 10, 60), (0.4, 0.05, 50, 85), (0.1, 0.8, 90, 30)]:
        cosine, end = math.cos(math.radians(degrees)), min(1, 6 / math.sqrt(n + 1))
        row = np.array([reflectivity(n, end * i / INTERVALS) for i in range(INTERVALS + 1)], np.float32)
        table = cl.Buffer(context, cl.mem_flags.READ_ONLY | cl.mem_flags.COPY_HOST_PTR, hostbuf=row)
        kernel(queue, (WORK_ITEMS,), None, np.float32(kd), np.float32(ks), np.float32(n), table, np.float32(cosine),
               np.array([7, 0], np.uint32).view(cl.cltypes.uint2)[0], np.int32(SAMPLES), result)
        cl.enqueue_copy(queue, means, result)
        exact = kd + ks * (reflectivity(n, cosine) if cosine < end else cosine)
        error, tolerance = means.mean(dtype=float) - exact, means.std(dtype=float) / math.sqrt(WORK_ITEMS)
        wrong += abs(error) > 5 * tolerance + 1e-4 * exact  # 1e-4: of the table in float32
        print(f"kd {kd}, ks {ks}, n {n}, {degrees} degrees: {exact + error:.6f}, exactly {exact:.6f}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
