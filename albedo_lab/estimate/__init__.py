"""A model and a question in, an Estimate out: scrambled Sobol points, plain Monte Carlo, or quadrature."""
