"""The report engine from Python: engines, documents and figures by the names of `reports`."""
