"""The documents on trial: what each prints, as data, and how every printed figure is recomputed and judged."""
