/* SPDX-License-Identifier: GPL-2.0-or-later
   Bandwidth of a = b + s c, for bench_lsm.py: on all ranks at the same time, for sets of data of the given megabytes on each.
   Rank 0 prints a line
     triad MEGABYTES GB_PER_SECOND
   for each, of one rank in the mean, the best of five; 24 bytes for an element. */
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv)
{
  int rank, ranks;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  for (int k = 1; k < argc; k++) {
    const double megabytes = atof(argv[k]);
    const long n = (long) (megabytes * 1e6 / 24);
    double *data = malloc(3 * n * sizeof(double)), best = 0.0;
    if (!data || n < 1) MPI_Abort(MPI_COMM_WORLD, 1);
    double *a = data, *b = a + n, *c = b + n;
    for (long i = 0; i < n; i++) a[i] = b[i] = c[i] = 1.0;
    const int times = 1 + (int) (1e9 / (24.0 * n));
    for (int turn = 0; turn < 5; turn++) {
      MPI_Barrier(MPI_COMM_WORLD);
      const double start = MPI_Wtime();
      for (int t = 0; t < times; t++) {
        const double s = 1.0 + 1e-9 * t;
        for (long i = 0; i < n; i++) a[i] = b[i] + s * c[i];
        __asm__ volatile("" : : "r"(a) : "memory");    /* so that no pass is left out */
      }
      double speed = 24e-9 * n * times / (MPI_Wtime() - start), sum;
      MPI_Allreduce(&speed, &sum, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
      if (sum / ranks > best) best = sum / ranks;
    }
    if (rank == 0) printf("triad %g %.3f\n", megabytes, best);
    free(data);
  }
  MPI_Finalize();
  return 0;
}
