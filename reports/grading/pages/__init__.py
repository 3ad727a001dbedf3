"""Pages and tables for people; one verdict explained."""
