"""Methods that others use, on the engine's own pipeline and columns (`torquescope diagnose --columns`).

A rival is one file with `answer(columns) -> Answer` (columns.py) and one line here. None of them sees a truth or a
replicate.
"""

from . import hac_wald, iid_f, lasso_cv, nested_friction, stlsq_ensemble

METHODS = {
    "iid_f": iid_f.answer,                      # F-tests as if the noise were white, Benjamini-Hochberg
    "hac_wald": hac_wald.answer,                # Wald tests with Newey-West errors, Benjamini-Hochberg
    "lasso_cv": lasso_cv.answer,                # LASSO, penalty by blocked cross-validation
    "stlsq_ensemble": stlsq_ensemble.answer,    # sequentially thresholded least squares, bagged: the PySINDy way
    "nested_friction": nested_friction.answer,  # friction models from simple to rich by validation error: the BAM way
}
