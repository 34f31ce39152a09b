#!/usr/bin/python3
"""How often does a filter that is exactly right keep "mean NEES of 100 runs inside its 95 % band at 90 % of the epochs"?

A linear twin of kernels/instruments/navigation_filter/consistency_test.cpp: 28 errors driven by the very noise that a Kalman filter is given,
on the same mission, fibre-optic grade. The filter is right by construction, so what its hundreds of runs do is luck alone.

  consistency.py [--runs 10000] [--measured FILE] [--picture FILE]

FILE holds the shares of epochs inside that hundreds of the real filter had, one a line: navigation_filter_test "[hundreds]".
"""
import argparse

import numpy as np

DEGREE, UG, GRAVITY, RADIUS_M, EARTH_RADPS = np.pi / 180, 9.80665e-6, 9.806, 6.371e6, 7.292e-5
POSITION, VELOCITY, ROTATION, GYRO, FORCE, FIX, SCALE, MATRIX, ERRORS = 0, 3, 6, 9, 12, 15, 18, 19, 28
STEP_S, END_S, FIXES_S = 0.2, 400, 150
LATITUDE = 44 * DEGREE
MISALIGNMENT = 0.003 * DEGREE
FREEDOM, HUNDRED, LOW, HIGH = 9, 100, 8.19, 9.85  # 95 % of chi-square with 900 degrees of freedom, over 100


def cross(v):
    x, y, z = v
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def start_variance():
    """Of the errors at the start: components/navigation/grades/imu_fog.yaml."""
    per_hour = DEGREE / 3600
    variance = np.zeros(ERRORS)
    variance[POSITION:POSITION + 3] = 1
    variance[VELOCITY:VELOCITY + 3] = 0.1**2
    variance[ROTATION:ROTATION + 3] = [(0.01 * DEGREE)**2, (0.01 * DEGREE)**2, (0.1 * DEGREE)**2]
    variance[GYRO:GYRO + 3] = (0.02 * per_hour)**2 + (0.005 * per_hour)**2
    leak = GRAVITY * np.array([MISALIGNMENT, MISALIGNMENT, 1e-4])
    variance[FORCE:FORCE + 3] = leak**2 + (50 * UG)**2 + (10 * UG)**2
    variance[FIX:FIX + 3] = [0.3**2, 0.3**2, 0.6**2]
    variance[SCALE] = 0.002**2
    variance[MATRIX:] = np.where(np.eye(3).ravel() > 0, 3e-5, MISALIGNMENT)**2
    return variance


def drive():
    """Spectral densities of the noise that drives each error."""
    density = np.zeros(ERRORS)
    density[VELOCITY:VELOCITY + 3] = (10 * UG)**2
    density[ROTATION:ROTATION + 3] = (0.005 * DEGREE / 60)**2
    density[GYRO:GYRO + 3] = 2 * (0.005 * DEGREE / 3600)**2 / 3600
    density[FORCE:FORCE + 3] = 2 * (10 * UG)**2 / 3600
    density[FIX:FIX + 3] = 2 / 200 * np.array([0.3**2, 0.3**2, 0.6**2])
    return density


def vehicle(t_s):
    """Attitude, turn rate along the body, velocity and acceleration (north, east, down) on the mission of the test."""
    leg, line_s, turn_s = t_s % 140, 80, 60
    sign = -1 if t_s % 280 > 140 else 1
    rate = sign * np.pi / turn_s if leg > line_s else 0.0
    turned = sum((-1)**k * np.pi for k in range(int(t_s // 140))) + sign * np.pi / turn_s * max(leg - line_s, 0)
    heading, roll, roll_rate = 30 * DEGREE + turned, 2 * DEGREE * np.sin(t_s), 2 * DEGREE * np.cos(t_s)
    ch, sh, cr, sr = np.cos(heading), np.sin(heading), np.cos(roll), np.sin(roll)
    attitude = np.array([[ch, -sh, 0], [sh, ch, 0], [0, 0, 1]]) @ np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    turning = np.array([roll_rate, rate * sr, rate * cr])
    return attitude, turning, 2 * np.array([ch, sh, 0]), 2 * rate * np.array([-sh, ch, 0])


def rates(t_s):
    attitude, turning, velocity, acceleration = vehicle(t_s)
    earth = EARTH_RADPS * np.array([np.cos(LATITUDE), 0, -np.sin(LATITUDE)])
    transport = np.array([velocity[1], -velocity[0], -velocity[1] * np.tan(LATITUDE)]) / RADIUS_M
    f = np.zeros((ERRORS, ERRORS))
    f[POSITION:3, VELOCITY:VELOCITY + 3] = np.eye(3)
    f[VELOCITY:6, VELOCITY:6] = -cross(2 * earth + transport)
    f[VELOCITY:6, ROTATION:9] = -cross(acceleration - [0, 0, GRAVITY])
    f[VELOCITY:6, FORCE:FORCE + 3] = -attitude
    f[VELOCITY + 2, POSITION + 2] = 2 * GRAVITY / RADIUS_M
    f[ROTATION:9, ROTATION:9] = -cross(earth + transport)
    f[ROTATION:9, GYRO:GYRO + 3] = -attitude
    for row in range(3):
        f[ROTATION:9, MATRIX + 3 * row:MATRIX + 3 * row + 3] = -np.outer(attitude[:, row], turning)
    f[ROTATION, VELOCITY + 1], f[ROTATION + 1, VELOCITY] = -1 / RADIUS_M, 1 / RADIUS_M
    f[FIX:FIX + 3, FIX:FIX + 3] = -np.eye(3) / 200
    return f


def observations(t_s):
    """Rows and standard deviations of what is measured each second: fixes for a start, log, depth."""
    attitude, _, velocity, _ = vehicle(t_s)
    rows, sigma = [], []
    if t_s <= FIXES_S:
        fix = np.zeros((3, ERRORS))
        fix[:, POSITION:3] = fix[:, FIX:FIX + 3] = np.eye(3)
        rows.append(fix)
        sigma += [0.02] * 3
    log = np.zeros((3, ERRORS))
    log[:, VELOCITY:6] = attitude.T
    log[:, ROTATION:9] = attitude.T @ cross(velocity)
    log[:, SCALE] = attitude.T @ velocity
    depth = np.zeros((1, ERRORS))
    depth[0, POSITION + 2] = 1
    return np.vstack(rows + [log, depth]), np.array(sigma + [0.01] * 3 + [0.05])


def mean_nees(runs, seed=1):
    """Epoch by epoch (each 5 s), for each hundred of the runs: (hundreds, epochs)."""
    random = np.random.default_rng(seed)
    covariance = np.diag(start_variance())
    errors = np.sqrt(start_variance())[:, None] * random.standard_normal((ERRORS, runs))
    noise = drive() * STEP_S
    driven = np.flatnonzero(noise)
    epochs = []
    for n in range(1, round(END_S / STEP_S) + 1):
        ft = STEP_S * rates((n - 0.5) * STEP_S)
        move = np.eye(ERRORS) + ft + 0.5 * ft @ ft
        covariance = move @ covariance @ move.T + np.diag(noise)
        errors = move @ errors
        errors[driven] += np.sqrt(noise[driven])[:, None] * random.standard_normal((driven.size, runs))
        if n % 5 == 0:
            rows, sigma = observations(n * STEP_S)
            seen = covariance @ rows.T
            gain = np.linalg.solve(rows @ seen + np.diag(sigma**2), seen.T).T
            errors -= gain @ (rows @ errors + sigma[:, None] * random.standard_normal((sigma.size, runs)))
            keep = np.eye(ERRORS) - gain @ rows
            covariance = keep @ covariance @ keep.T + gain * sigma**2 @ gain.T
        if n % 25 == 0:
            whitened = np.linalg.solve(np.linalg.cholesky(covariance[:FREEDOM, :FREEDOM]), errors[:FREEDOM])
            epochs.append(np.sum(whitened**2, axis=0).reshape(-1, HUNDRED).mean(axis=1))
    return np.stack(epochs, axis=1)


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--runs", type=int, default=10000)
    arguments.add_argument("--measured")
    arguments.add_argument("--picture")
    options = arguments.parse_args()
    means = mean_nees(options.runs)
    inside = np.mean((means > LOW) & (means < HIGH), axis=1)
    between = np.corrcoef(means.T)[np.triu_indices(means.shape[1], 1)].mean()
    print(f"a right filter: {len(means)} hundreds, mean NEES {means.mean():.3f}, inside {inside.mean():.3f} of all epochs")
    print(f"  correlation between epochs {between:.2f}; 90 % of the epochs inside in {np.mean(inside >= 0.9):.3f} of the hundreds")
    shown = [(inside, "filter that is right by construction")]
    if options.measured:
        measured = np.loadtxt(options.measured, ndmin=1)
        print(f"the real one: {measured.size} hundreds, inside {measured.mean():.3f}; 90 % in {np.mean(measured >= 0.9):.3f} of them")
        shown.append((measured, "the real filter"))
    if options.picture:
        from matplotlib.figure import Figure

        figure = Figure(figsize=(6.4, 3.6), layout="constrained")
        axes = figure.subplots()
        for shares, label in shown:
            axes.plot(np.sort(shares), (np.arange(shares.size) + 0.5) / shares.size, drawstyle="steps-mid",
                      label=f"{label}: {shares.size} hundreds")
        axes.axvline(0.9, color="0.5", linewidth=0.8)
        axes.set(xlabel="share of epochs whose mean NEES of 100 runs is in its 95 % band", ylabel="share of hundreds, at most that",
                 ylim=(0, 1))
        axes.legend(loc="upper left", frameon=False)
        figure.savefig(options.picture, dpi=150)


if __name__ == "__main__":
    main()
