/* Counts what a program sends by MPI: a library to preload, which prints its table in MPI_Finalize().

     mpicc -shared -fPIC -O2 messages.c -o libmessages.so
     mpiexec -n 4 env LD_PRELOAD=$PWD/libmessages.so MESSAGES=table.txt lmp -in in.script

   A line for each rank: messages to other ranks, their bytes, collective operations, their bytes on this rank.
   The MPI standard, 4.0, chapter 14: the library has functions of MPI's names, which call those of the names PMPI_*. */

#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>

enum { MESSAGES, BYTES, COLLECTIVES, COLLECTIVE_BYTES, NCOUNT };
static long long counts[NCOUNT];

static void count(int kind, int number, MPI_Datatype type)
{
  int size = 0;
  if (number > 0) PMPI_Type_size(type, &size);
  counts[kind]++;
  counts[kind + 1] += (long long) number * size;
}

/* messages from one rank to another, counted by the sender */

#define SEND(name)                                                                                   \
  int MPI_##name(const void *buf, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm)         \
  {                                                                                                  \
    count(MESSAGES, n, type);                                                                        \
    return PMPI_##name(buf, n, type, to, tag, comm);                                                 \
  }
SEND(Send)
SEND(Rsend)
SEND(Ssend)

int MPI_Isend(const void *buf, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request *request)
{
  count(MESSAGES, n, type);
  return PMPI_Isend(buf, n, type, to, tag, comm, request);
}

int MPI_Sendrecv(const void *buf, int n, MPI_Datatype type, int to, int tag, void *into, int most,
                 MPI_Datatype type_from, int from, int tag_from, MPI_Comm comm, MPI_Status *status)
{
  count(MESSAGES, n, type);
  return PMPI_Sendrecv(buf, n, type, to, tag, into, most, type_from, from, tag_from, comm, status);
}

/* collective operations: the bytes that this rank brings */

int MPI_Allreduce(const void *from, void *to, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm)
{
  count(COLLECTIVES, n, type);
  return PMPI_Allreduce(from, to, n, type, op, comm);
}

int MPI_Reduce(const void *from, void *to, int n, MPI_Datatype type, MPI_Op op, int root, MPI_Comm comm)
{
  count(COLLECTIVES, n, type);
  return PMPI_Reduce(from, to, n, type, op, root, comm);
}

int MPI_Scan(const void *from, void *to, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm)
{
  count(COLLECTIVES, n, type);
  return PMPI_Scan(from, to, n, type, op, comm);
}

int MPI_Bcast(void *buf, int n, MPI_Datatype type, int root, MPI_Comm comm)
{
  count(COLLECTIVES, n, type);
  return PMPI_Bcast(buf, n, type, root, comm);
}

int MPI_Allgather(const void *from, int n, MPI_Datatype type, void *to, int n_to, MPI_Datatype type_to,
                  MPI_Comm comm)
{
  count(COLLECTIVES, n, type);
  return PMPI_Allgather(from, n, type, to, n_to, type_to, comm);
}

int MPI_Allgatherv(const void *from, int n, MPI_Datatype type, void *to, const int *n_to, const int *places,
                   MPI_Datatype type_to, MPI_Comm comm)
{
  count(COLLECTIVES, n, type);
  return PMPI_Allgatherv(from, n, type, to, n_to, places, type_to, comm);
}

int MPI_Barrier(MPI_Comm comm)
{
  count(COLLECTIVES, 0, MPI_BYTE);
  return PMPI_Barrier(comm);
}

int MPI_Finalize(void)
{
  int me, nprocs;
  PMPI_Comm_rank(MPI_COMM_WORLD, &me);
  PMPI_Comm_size(MPI_COMM_WORLD, &nprocs);
  long long *all = malloc(sizeof(counts) * nprocs);
  PMPI_Gather(counts, NCOUNT, MPI_LONG_LONG, all, NCOUNT, MPI_LONG_LONG, 0, MPI_COMM_WORLD);
  const char *name = getenv("MESSAGES");
  FILE *table = me ? NULL : (name ? fopen(name, "w") : stderr);
  for (int p = 0; table && p < nprocs; p++) {
    for (int k = 0; k < NCOUNT; k++) fprintf(table, "%lld%s", all[p * NCOUNT + k], k < NCOUNT - 1 ? " " : "\n");
  }
  if (table && name) fclose(table);
  free(all);
  return PMPI_Finalize();
}
