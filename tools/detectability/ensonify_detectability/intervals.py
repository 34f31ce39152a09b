"""Exact intervals of 95 %: of a probability (Clopper and Pearson 1934), and of a rate of Poisson (Garwood 1936)."""
from scipy import stats

OUTSIDE = 0.05


def of_share(hits: int, of: int) -> tuple:
    """Least and largest probability with which so many of so many are plausible. (0, 1) of none."""
    least = 0.0 if hits == 0 else float(stats.beta.ppf(OUTSIDE / 2, hits, of - hits + 1))
    most = 1.0 if hits == of else float(stats.beta.ppf(1 - OUTSIDE / 2, hits + 1, of - hits))
    return least, most


def of_count(count: int) -> tuple:
    """Least and largest mean with which a count is plausible."""
    least = 0.0 if count == 0 else float(0.5 * stats.chi2.ppf(OUTSIDE / 2, 2 * count))
    return least, float(0.5 * stats.chi2.ppf(1 - OUTSIDE / 2, 2 * count + 2))
