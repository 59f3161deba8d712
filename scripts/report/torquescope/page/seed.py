"""Tables 3 and 4 of the paper that started this study, and what cannot be true in them.

Source     FADE on the CRS A465: Table 3 (parameters, mean of 30 runs), Table 4 (MSE and "Std Dev")
"""

import math

PARAMETERS = ("inertia", "viscous", "coulomb_positive", "coulomb_negative")
# label: values in this order
TABLE_3 = {"OLS": (0.0036, 0.0164, 0.0089, -0.2582), "DE": (0.0037, 0.0143, 0.0594, -0.3060),
           "FADE": (0.0038, 0.0169, 0.0112, -0.2261)}
# label: MSE, standard deviation of the prediction error
TABLE_4 = {"OLS": (9.259e-2, 2.099), "DE": (8.872e-2, 1.415), "FADE": (5.233e-2, 1.380)}


def largest_deviation(label):
    """No residual has a standard deviation above the root of its mean square."""
    return math.sqrt(TABLE_4[label][0])
