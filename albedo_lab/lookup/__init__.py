"""Tables for renderers: cells with a proven error, one writer a format, one preset a renderer, and the audit of others."""
