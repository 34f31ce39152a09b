"""Draws docs/physics/pictures: motion.py build/dev/bin/ensonify-physics"""

import values
from values import np, physics, plt



def spectrum(x, length=256):
    """Power per Hz of samples at 1 Hz, by Welch's method."""
    window = np.hanning(length)
    parts = [np.abs(np.fft.rfft(window * x[i:i + length])) ** 2 for i in range(0, len(x) - length + 1, length // 2)]
    return np.fft.rfftfreq(length), 2 * np.mean(parts, axis=0) / np.sum(window ** 2)


def disturbance():
    short = physics("disturbance", "--preset", "research_ship", "--t-s", "0:120:0.5")
    long = physics("disturbance", "--preset", "research_ship", "--t-s", "0:3599:1")
    figure, (above, below) = plt.subplots(2, 1, figsize=(8, 7), constrained_layout=True)
    for name, label, peak_s, colour in (("heave_m", "heave, m", 10.7, "C0"), ("pitch_deg", "pitch, deg", 9.1, "C1"),
                                        ("roll_deg", "roll, deg", 12.8, "C2")):
        above.plot(short["t_s"], short[name], colour, label=label)
        f, power = spectrum(long[name])
        below.semilogy(f, power, colour, label=f"{label}: sd {np.std(long[name]):.2f}")
        below.plot(1 / peak_s, np.interp(1 / peak_s, f, power), colour + "x", markersize=10)
    above.set(xlabel="time, s", ylim=(-6, 10))
    below.set(xlabel="frequency, Hz", ylabel="power per Hz", xlim=(0, 0.3), ylim=(1e-3, 1e3))
    for axes in (above, below):
        axes.legend(loc="upper right")
        axes.grid(alpha=0.3)
    values.save(figure, "disturbance")


def tide():
    level = physics("tide", "--t-h", "0:360:0.5")
    figure, axes = plt.subplots(figsize=(8, 3.2), constrained_layout=True)
    axes.plot(level["t_h"] / 24, level["level_m"])
    axes.axhline(2.0, color="grey", linewidth=0.8)
    axes.axvline(14.7653 / 2, color="C1", linestyle="--", label="neaps, 14.765 / 2 days")
    axes.set(xlabel="time, days", ylabel="above chart datum, m", ylim=(-1, 4.2))
    axes.legend(loc="lower right")
    values.save(figure, "tide")


disturbance()
tide()
