"""Lays out what others computed: tables, plots, the audit of the documents. Computes nothing."""
