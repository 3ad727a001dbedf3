"""The report engine: files, tables and people around the solver `kshm`."""
