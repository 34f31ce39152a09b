"""What soundings say of their own uncertainty: against what IHO S-44 allows, and against the truth."""
import numpy as np

LEAST_INSIDE = 0.9  # share of true errors inside the TVU where 0.95 is right
CLASSES = 10  # of beam angle, in which predictions are held against errors

# IHO S-44, edition 6.1.0, table 1: order, a (m) and b of the TVU sqrt(a^2 + (b depth)^2), THU in m and share of the depth. Orders 1a
# and 1b allow the same; which of them a survey is depends on its coverage.
ORDERS = (("Exclusive Order", 0.15, 0.0075, 1.0, 0.0), ("Special Order", 0.25, 0.0075, 2.0, 0.0),
          ("Order 1a", 0.5, 0.013, 5.0, 0.05), ("Order 2", 1.0, 0.023, 20.0, 0.1))


def stated(tvu_m, thu_m, depth_m) -> dict | None:
    """Medians of the predicted TVU and THU, the share of soundings that keeps each order's limits, and the strictest order that 95 %
    of the soundings keep (None: not even order 2). None if no sounding gives."""
    reported = np.isfinite(tvu_m) & np.isfinite(thu_m)
    if not reported.any():
        return None
    tvu_m, thu_m, depth_m = tvu_m[reported], thu_m[reported], depth_m[reported]
    shares = {order: float(np.mean((tvu_m <= np.hypot(a, b * depth_m)) & (thu_m <= m + share * depth_m)))
              for order, a, b, m, share in ORDERS}
    return {"soundings": int(reported.sum()), "tvu_m": float(np.median(tvu_m)), "thu_m": float(np.median(thu_m)), "share_that_keeps": shares,
            "order": next((order for order, share in shares.items() if share >= 0.95), None)}


def order_of_errors(error_m, depth_m) -> str | None:
    """The strictest order whose TVU 95 % of the true errors of height keep (None: not even order 2). Where soundings truly lie is not asked."""
    error_m, depth_m = (values[np.isfinite(error_m)] for values in (np.abs(error_m), depth_m))
    return next((order for order, a, b, _, _ in ORDERS if np.mean(error_m <= np.hypot(a, b * depth_m)) >= 0.95), None)


def warning(truth: dict | None, stated: dict | None) -> str | None:
    """What is said where soundings claim more than their true errors keep."""
    if not truth or not stated:
        return None
    orders = [*(order for order, *_ in ORDERS), None]
    if orders.index(stated["order"]) < orders.index(truth["order"]):
        return (f"the soundings state {stated['order']}, and their true errors keep {truth['order'] or 'no order'}: something is wrong that they "
                "do not know of, such as a mounting, a sound speed or a tide")
    if truth.get("inside_tvu", 1.0) < LEAST_INSIDE:
        return (f"only {truth['inside_tvu']:.1%} of the true errors are inside the stated TVU: something is wrong that the soundings do not know "
                "of, such as a mounting, a sound speed or a tide")
    return None


def kept(error_m, tvu_m, angle_rad) -> dict | None:
    """Share of vertical errors inside the predicted TVU: of all, and by class of beam angle, as many soundings in each. 0.95 is right."""
    known = np.isfinite(error_m) & np.isfinite(tvu_m)
    if np.count_nonzero(known) < CLASSES:
        return None
    inside, angle_deg = (np.abs(error_m) <= tvu_m)[known], np.degrees(angle_rad[known])
    order = np.argsort(angle_deg, kind="stable")
    classes = np.array_split(order, CLASSES)
    return {"inside_tvu": float(inside.mean()), "inside_tvu_by_angle": [float(inside[c].mean()) for c in classes],
            "middle_of_class_deg": [float(np.median(angle_deg[c])) for c in classes]}
