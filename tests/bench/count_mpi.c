/* SPDX-License-Identifier: GPL-2.0-or-later
   Counts what a program sends, for bench_lsm.py: loaded before the MPI library (LD_PRELOAD), it stands between program
   and library. At the end each rank prints a line
     count_mpi RANK messages BYTES collectives nonblocking
   of all messages to other ranks, their bytes, collective calls that wait, and collective calls that do not. */
#include <mpi.h>
#include <stdio.h>

static long messages, collectives, nonblocking;
static double bytes;

static void sent(int count, MPI_Datatype type, int to, MPI_Comm comm)
{
  int size, me;
  PMPI_Comm_rank(comm, &me);
  if (to == me || to == MPI_PROC_NULL) return;
  PMPI_Type_size(type, &size);
  messages++;
  bytes += (double) size * count;
}

int MPI_Send(const void *buf, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm)
{
  sent(count, type, to, comm);
  return PMPI_Send(buf, count, type, to, tag, comm);
}

int MPI_Isend(const void *buf, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request *request)
{
  sent(count, type, to, comm);
  return PMPI_Isend(buf, count, type, to, tag, comm, request);
}

int MPI_Sendrecv(const void *out, int count, MPI_Datatype type, int to, int tag, void *in, int in_count,
                 MPI_Datatype in_type, int from, int in_tag, MPI_Comm comm, MPI_Status *status)
{
  sent(count, type, to, comm);
  return PMPI_Sendrecv(out, count, type, to, tag, in, in_count, in_type, from, in_tag, comm, status);
}

int MPI_Allreduce(const void *in, void *out, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm)
{
  collectives++;
  return PMPI_Allreduce(in, out, count, type, op, comm);
}

int MPI_Reduce(const void *in, void *out, int count, MPI_Datatype type, MPI_Op op, int root, MPI_Comm comm)
{
  collectives++;
  return PMPI_Reduce(in, out, count, type, op, root, comm);
}

int MPI_Bcast(void *buf, int count, MPI_Datatype type, int root, MPI_Comm comm)
{
  collectives++;
  return PMPI_Bcast(buf, count, type, root, comm);
}

int MPI_Gather(const void *in, int n, MPI_Datatype type, void *out, int m, MPI_Datatype other, int root, MPI_Comm comm)
{
  collectives++;
  return PMPI_Gather(in, n, type, out, m, other, root, comm);
}

int MPI_Allgather(const void *in, int n, MPI_Datatype type, void *out, int m, MPI_Datatype other, MPI_Comm comm)
{
  collectives++;
  return PMPI_Allgather(in, n, type, out, m, other, comm);
}

int MPI_Barrier(MPI_Comm comm)
{
  collectives++;
  return PMPI_Barrier(comm);
}

int MPI_Iallreduce(const void *in, void *out, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm, MPI_Request *request)
{
  nonblocking++;
  return PMPI_Iallreduce(in, out, count, type, op, comm, request);
}

int MPI_Igather(const void *in, int n, MPI_Datatype type, void *out, int m, MPI_Datatype other, int root, MPI_Comm comm,
                MPI_Request *request)
{
  nonblocking++;
  return PMPI_Igather(in, n, type, out, m, other, root, comm, request);
}

int MPI_Finalize(void)
{
  int me;
  PMPI_Comm_rank(MPI_COMM_WORLD, &me);
  fprintf(stderr, "count_mpi %d %ld %.0f %ld %ld\n", me, messages, bytes, collectives, nonblocking);
  return PMPI_Finalize();
}
