"""From templates to pages: numbering, tables, rendering."""
