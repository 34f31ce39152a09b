#!/usr/bin/python3
"""Draws the pictures of the pages on water and on the sonar equation, from `ensonify physics` beside what it is checked by.

    docs/physics/draw/water.py build/dev/bin/ensonify-physics
"""
import matplotlib.pyplot as plt
import numpy as np

from values import physics, save


def finish(figure, name):
    for axis in figure.axes:
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    save(figure, name)


def depth_of(pressure_dbar):
    """[Saunders1981] at 45 degrees."""
    return (1 - 5.92e-3 - 5.25e-3 * 0.5) * pressure_dbar - 2.21e-6 * pressure_dbar**2


def draw_sound_speed():
    figure, (table, gibbs) = plt.subplots(1, 2, figsize=(10, 4), constrained_layout=True)

    printed = {  # [Fofonoff1983] p. 50, 35 psu: dbar -> m/s at 0, 10, 20, 30, 40 degC by the scale of 1968
        0: (1449.1, 1489.8, 1521.5, 1545.6, 1563.2), 1000: (1465.5, 1506.3, 1538.1, 1562.4, 1580.2),
        2000: (1482.3, 1523.0, 1554.7, 1579.2, 1597.1), 3000: (1499.3, 1539.7, 1571.3, 1595.9, 1613.9),
        4000: (1516.5, 1556.5, 1587.9, 1612.5, 1630.7), 5000: (1534.0, 1573.4, 1604.5, 1629.0, 1647.3),
        6000: (1551.6, 1590.4, 1621.0, 1645.4, 1663.8), 7000: (1569.4, 1607.5, 1637.6, 1661.7, 1680.1),
        8000: (1587.2, 1624.6, 1654.1, 1677.9, 1696.2), 9000: (1605.2, 1641.8, 1670.6, 1694.0, 1712.2),
        10000: (1623.2, 1659.0, 1687.2, 1710.1, 1727.8)}
    for column, celsius in enumerate((0, 10, 20, 30, 40)):
        error = [physics("sound-speed", "--law", "unesco", "--temperature-degc", celsius / 1.00024, "--depth-m",
                         depth_of(dbar))["sound_speed_mps"][0] - speeds[column] for dbar, speeds in printed.items()]
        table.plot(np.array(list(printed)) / 1000, error, "o", ms=4, label=f"{celsius} °C")
    table.axhspan(-0.05, 0.05, color="0.9", label="rounding of the table")
    table.set(xlabel="pressure, 1000 dbar", ylabel="kernel - table, m/s", ylim=(-0.1, 0.1),
              title="UNESCO law against the table of UNESCO 44, 35 psu")

    samples = np.array([  # [TEOS10]: absolute salinity, degC, dbar, m/s
        (34.7118, 28.7856, 10, 1542.6158), (34.8915, 28.4329, 50, 1542.7035), (35.0256, 22.8103, 125, 1530.8450),
        (34.8472, 10.2600, 250, 1494.4100), (34.7366, 6.8863, 600, 1487.3771), (34.7324, 4.4036, 1000, 1483.9346)])
    for law, standard_error in (("mackenzie", 0.07), ("unesco", 0.19), ("del-grosso", 0.05)):
        error = [physics("sound-speed", "--law", law, "--temperature-degc", t, "--salinity-psu", s * 35 / 35.16504,
                         "--depth-m", depth_of(p))["sound_speed_mps"][0] - c for s, t, p, c in samples]
        gibbs.errorbar(samples[:, 2], error, yerr=standard_error, fmt="o-", ms=4, capsize=3,
                       label=f"{law}, ± its standard error")
    gibbs.axhline(0, color="k", lw=0.8)
    gibbs.set(xlabel="pressure, dbar", ylabel="law - TEOS-10, m/s", title="Three laws against the Gibbs function")
    finish(figure, "sound_speed")


def draw_absorption():
    figure, (level, ratio) = plt.subplots(2, 1, figsize=(8, 6.5), sharex=True, constrained_layout=True)
    printed = {0: [(200, 40.6)], 4: [(700, 228)], 10: [(100, 33.6), (300, 73.1), (500, 125)], 30: [(1000, 344)]}
    khz = np.geomspace(1, 1000, 61)
    for colour, (celsius, points) in enumerate(printed.items()):
        def law(name):
            return np.array([physics("absorption", "--law", name, "--frequency-hz", 1e3 * f, "--temperature-degc",
                                     celsius)["absorption_db_per_km"][0] for f in khz])
        francois, ainslie = law("francois-garrison"), law("ainslie-mccolm")
        level.loglog(khz, francois, f"C{colour}-", lw=1, label=f"Francois-Garrison, {celsius} °C")
        level.loglog(khz, ainslie, f"C{colour}--", lw=0.8)
        level.loglog(*zip(*points), f"C{colour}o", ms=5)
        ratio.semilogx(khz, 100 * (ainslie / francois - 1), f"C{colour}", lw=1, label=f"{celsius} °C")
    level.plot([], [], "k--", lw=0.8, label="Ainslie-McColm")
    level.plot([], [], "ko", ms=5, label="printed values")
    level.set(ylabel="absorption, dB/km", title="Absorption at the surface, 35 psu, pH 8")
    ratio.axhspan(-10, 10, color="0.9", label="10 % of Ainslie and McColm")
    ratio.set(xlabel="frequency, kHz", ylabel="Ainslie-McColm over\nFrancois-Garrison, %")
    finish(figure, "absorption")


def draw_noise():
    figure, axis = plt.subplots(figsize=(8, 4.5), constrained_layout=True)
    hz = np.geomspace(1e3, 1e6, 61)
    thermal = np.array([physics("noise", "--frequency-hz", f)["thermal_db"][0] for f in hz])
    axis.semilogx(hz / 1e3, thermal, "k", label="thermal")
    mellen = 4 * np.pi * 1.380649e-23 * 283.15 * 1027 * hz**2 / 1490 * 1e12
    axis.semilogx(hz[::5] / 1e3, 10 * np.log10(mellen[::5]), "k+", label="4 π k T ρ f² / c at 10 °C")
    for colour, (mps, crossing_khz) in enumerate({5: 85, 10: 115, 15: 140}.items()):
        rows = [physics("noise", "--frequency-hz", f, "--wind-speed-mps", mps) for f in hz]
        wind, ambient = (np.array([row[name][0] for row in rows]) for name in ("wind_db", "ambient_db"))
        axis.semilogx(hz / 1e3, np.where(hz <= 50e3, wind, np.nan), f"C{colour}", label=f"wind, {mps} m/s")
        axis.semilogx(hz / 1e3, np.where(hz >= 45e3, wind, np.nan), f"C{colour}:")
        axis.semilogx(hz / 1e3, ambient, f"C{colour}--", lw=0.7)
        axis.axvline(crossing_khz, color=f"C{colour}", lw=0.6)
    axis.plot(1, 51.0, "ks", ms=5, label="rule of fives: 51 dB at 1 kHz in 5 kn")
    axis.plot([], [], "k:", label="extrapolated")
    axis.plot([], [], "k--", lw=0.7, label="both")
    axis.plot([], [], "k-", lw=0.6, label="crossings, read off such curves")
    axis.set(xlabel="frequency, kHz", ylabel="dB re 1 µPa²/Hz", ylim=(5, 75), title="Ambient noise")
    finish(figure, "noise")


def one_way(sine, length_in_waves):
    return np.sinc(length_in_waves * sine) ** 2


def draw_volume():
    """Against the integral over cells of a water-filled shell, beams of 50.76 / 2 degrees square, both ways."""
    length = 50.76 / 2
    sines = np.linspace(-0.5, 0.5, 1001)
    both_ways = one_way(sines, length) ** 2
    u, v = np.meshgrid(sines, sines)
    solid_angle = np.sum(np.outer(both_ways, both_ways) / np.sqrt(1 - u**2 - v**2)) * (sines[1] - sines[0]) ** 2
    figure, axis = plt.subplots(figsize=(8, 4.5), constrained_layout=True)
    ranges = np.array([1, 1.5, 2, 3, 5, 8, 12, 20, 35, 60, 100, 160])
    worst = 0.0
    for colour, sv in enumerate((-85, -70, -55)):
        def level(r):
            return physics("level", "volume", "--range-m", r, "--volume-scattering-db", sv, "--solid-angle-sr",
                           f"{solid_angle:.9f}")["level_db"][0]
        form = np.array([level(r) for r in ranges])
        integral = []
        for r in ranges:
            shell = np.linspace(-0.0375, 0.0375, 401) + r  # c tau / 2 of 0.075 m
            integral.append(210 + sv + 10 * np.log10(solid_angle * np.trapz(shell**-2 * 10 ** (-0.014 * shell), shell)))
        worst = max(worst, np.max(np.abs(form - integral)))
        axis.semilogx(ranges, form, f"C{colour}", label=f"closed form, Sv {sv} dB")
        axis.semilogx(ranges, integral, f"C{colour}o", ms=4)
    axis.plot([], [], "ko", ms=4, label=f"integral over the shell; at most {worst:.3f} dB apart")
    axis.set(xlabel="range, m", ylabel="dB re 1 µPa²", title="Volume reverberation: SL 210 dB, 100 µs, 2° x 2°, 70 dB/km")
    finish(figure, "volume")


def seabed_integral_db(altitude, ranges, pattern, source_level, db_per_m):
    """Highest level over `ranges` of a pulse's echo from a Lambert seabed of -25 dB, by cells of the plane.

    pattern takes the sines along and across track.
    """
    azimuth = np.linspace(-np.pi, np.pi, 4001)
    levels = []
    for middle in ranges:
        near, far = (np.sqrt(max(0.0, edge**2 - altitude**2)) for edge in (middle - 0.0375, middle + 0.0375))
        ground = np.linspace(near, far, 301)[:, None]
        r = np.hypot(ground, altitude)
        power = 10**-2.5 * (altitude / r) ** 2 * r**-4.0 * 10 ** (-0.2 * db_per_m * r) * ground
        weighted = power * pattern(ground / r * np.sin(azimuth), ground / r * np.cos(azimuth))
        levels.append(source_level + 10 * np.log10(np.trapz(np.trapz(weighted, azimuth, axis=1), ground[:, 0])))
    return max(levels)


def draw_sonar_equation():
    figure, (side, multi) = plt.subplots(1, 2, figsize=(10, 4), constrained_layout=True)
    ranges = np.array([10.5, 11, 12, 15, 20, 30, 50, 70, 100])
    form = np.array([physics("level", "sidescan", "--range-m", r, "--altitude-m", 10, "--absorption-db-per-km",
                             100)["level_db"][0] for r in ranges])
    length = 50.76 / 0.5
    integral = [seabed_integral_db(10, [r], lambda u, v: np.where(v > 0, one_way(u, length) ** 2, 0.0), 210, 0.1)
                for r in ranges]
    side.plot(ranges, form - integral, "o-", ms=4, label="0.5°, 10 m above the seabed")
    side.set(xlabel="range, m", ylabel="closed form - area integral, dB", ylim=(-0.2, 0.2), title="Sidescan")

    angles = np.array([0, 2, 5, 7, 8, 9, 10, 12, 15, 20, 25, 30, 35, 40, 45, 50, 55, 60, 65])
    form = np.array([physics("level", "multibeam", "--source-level-db", 220, "--beam-angle-deg", a)["level_db"][0]
                     for a in angles])
    length = 50.76
    integral = []
    for angle in np.radians(angles):
        middle, beam = 20 / np.cos(angle), np.sin(angle)
        integral.append(seabed_integral_db(20, middle + np.linspace(-0.03, 0.12, 16) * np.sqrt(middle / 20),
                                           lambda u, v: one_way(u, length) * one_way(v - beam, length), 220, 0.07))
    print("multibeam, closed form - integral:", dict(zip(angles, np.round(form - integral, 2))))
    multi.plot(angles, form - integral, "o-", ms=4, label="1° x 1°, 20 m above the seabed")
    multi.axhline(0, color="k", lw=0.8)
    multi.set(xlabel="beam angle, deg", ylabel="closed form - area integral, dB", ylim=(-0.2, 1.4), title="Multibeam")
    finish(figure, "sonar_equation")


if __name__ == "__main__":
    for draw in (draw_sound_speed, draw_absorption, draw_noise, draw_volume, draw_sonar_equation):
        draw()
