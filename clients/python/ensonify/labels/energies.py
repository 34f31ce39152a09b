"""Energies of pings: who sends how much of each sample, expected over all draws of speckle and noise.

A head with `labels: energies` publishes energies/1 beside its pings and labels. Places are those of sources in
Energies.sources: 0 is noise. A source is an object or a sediment by one path (direct, surface, bottom), the surface overhead,
the water (volume) or interference.
"""
from typing import Iterator

import numpy as np

from ensonify.messages import Energies, Soundings
from ensonify.session import EXIT_BAD_INPUT, RunError

RESPONSE = 0.5  # least share of a sample that is a response


def topic_of(ping_topic: str) -> str:
    """Topic of the energies beside a ping's: eye/energies of eye/ping, side/energies_main of side/ping_main."""
    process, _, port = ping_topic.partition("/")
    return f"{process}/energies{port.removeprefix('ping')}"


def check(of: Energies, topic: str) -> None:
    """Raises RunError for runs that do not lie in the image, belong to no source or do not fit their energies."""
    if of.run.size == 0 and of.energy_upa2.size == 0:
        return
    if of.run.ndim != 2 or of.run.shape[1] != 4:
        raise RunError(f"{topic}: ping {of.ping}: runs of shape {of.run.shape}; allowed is (runs, 4)", EXIT_BAD_INPUT)
    place, beam, first, end = of.run.T
    if (place.min() < 0 or place.max() >= len(of.sources) or beam.min() < 0 or beam.max() >= of.beams
            or first.min() < 0 or end.max() > of.samples or (end <= first).any()):
        raise RunError(f"{topic}: ping {of.ping}: runs lie outside the image of {of.beams} x {of.samples} or name no source", EXIT_BAD_INPUT)
    if int((end - first).sum()) != of.energy_upa2.size:
        raise RunError(f"{topic}: ping {of.ping}: energy_upa2 does not fit its runs", EXIT_BAD_INPUT)


def _runs(of: Energies) -> Iterator[tuple]:
    """(place, beam, first, end, where its energies begin) of each run."""
    at = 0
    for place, beam, first, end in of.run:
        yield place, beam, first, end, at
        at += end - first


def energy(of: Energies, place: int) -> np.ndarray:
    """Mean square that a source sends, uPa^2: beams x samples, float32; 0 where it is less than a millionth of the sample."""
    image = np.zeros((of.beams, of.samples), np.float32)
    for whose, beam, first, end, at in _runs(of):
        if whose == place:
            image[beam, first:end] = of.energy_upa2[at:at + end - first]
    return image


def total(of: Energies) -> np.ndarray:
    """Mean square of all sources together, uPa^2: beams x samples, float64. The mean of |p|^2 over draws."""
    image = np.zeros((of.beams, of.samples))
    for _, beam, first, end, at in _runs(of):
        image[beam, first:end] += of.energy_upa2[at:at + end - first]
    return image


def share(of: Energies, place: int) -> np.ndarray:
    """Part of each sample, 0..1, that a source sends: beams x samples; 0 where nothing is received."""
    all_of_it = total(of)
    return np.divide(energy(of, place), all_of_it, out=np.zeros_like(all_of_it), where=all_of_it > 0)


def response(of: Energies, place: int) -> np.ndarray:
    """Samples of which a source sends at least half, with pulse and side lobes: beams x samples, bool."""
    return share(of, place) >= RESPONSE


def strongest(of: Energies) -> np.ndarray:
    """Place of the source that sends most to each sample, of equals the earlier: beams x samples, int32; 0 where none does."""
    most = np.zeros((of.beams, of.samples), np.float32)
    who = np.zeros((of.beams, of.samples), np.int32)
    for place, beam, first, end, at in sorted(_runs(of), key=lambda run: run[0]):
        row = of.energy_upa2[at:at + end - first]
        more = row > most[beam, first:end]
        most[beam, first:end][more] = row[more]
        who[beam, first:end][more] = place
    return who


def of_soundings(soundings: Soundings, of: Energies) -> np.ndarray:
    """Place of the source that sends most at each detection of a multibeam: entries, int32; -1 outside the image."""
    time_s = soundings.travel_time_s.astype(np.float64)  # after the sector's own transmission
    if soundings.sectors and soundings.sector.size:
        time_s = time_s + np.array([sector.delay_s for sector in soundings.sectors])[soundings.sector]
    sample = np.rint((time_s - of.first_sample_s) / of.sample_period_s)
    inside = (sample >= 0) & (sample < of.samples)
    beam = soundings.beam if soundings.beam.size else np.arange(time_s.size)
    places = strongest(of)[beam, np.where(inside, sample, 0).astype(int)]
    return np.where(inside, places, -1)


def object_places(of: Energies) -> dict:
    """Place of each object's direct echo, by instance."""
    return {source.instance: place for place, source in enumerate(of.sources) if source.kind == "object" and source.path == "direct"}
