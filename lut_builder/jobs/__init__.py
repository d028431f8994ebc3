"""Pieces of work on processes, threads or a cluster, kept as they are done."""
