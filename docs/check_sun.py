#!/usr/bin/env python3
"""Holds `umbrage sun` against ERFA from outside: python3 docs/check_sun.py [UMBRAGE] (Debian: python3-erfa).

Nothing of Umbrage but its answers is used. Exit code 1 where a direction is off by more than 0.0001 degrees.
"""
import json
import random
import subprocess
import sys
import warnings

try:
    import erfa
    import numpy as np
except ImportError as missing:
    print(f"{missing}: install python3-erfa", file=sys.stderr)
    sys.exit(77)

# Of years to come nobody knows the leap seconds; both sides take today's.
warnings.simplefilter("ignore", erfa.ErfaWarning)

LIGHT_SECONDS_PER_AU = 499.004784


def sun_by_erfa(latitude, longitude, year, month, day, hour, minute):
    """East, north and up of the sun's centre, without refraction, UT1 = UTC."""
    utc = erfa.dtf2d("UTC", year, month, day, hour, minute, 0.0)
    tt = erfa.taitt(*erfa.utctai(*utc))
    site, _ = erfa.apco13(*utc, 0.0, np.radians(longitude), np.radians(latitude), 0, 0, 0, 0, 0, 0, 0.5)
    light_days = LIGHT_SECONDS_PER_AU / 86400
    for _ in range(3):  # where the sun was when the light left it
        heliocentric, barycentric = erfa.epv00(tt[0], tt[1] - light_days)
        towards = barycentric["p"] - heliocentric["p"] - site["eb"]
        light_days = np.linalg.norm(towards) * LIGHT_SECONDS_PER_AU / 86400
    seen = erfa.ab(towards / np.linalg.norm(towards), site["v"], site["em"], site["bm1"])
    right_ascension, declination = erfa.c2s(site["bpn"] @ seen)
    azimuth, zenith, *_ = erfa.atioq(right_ascension, declination, site)
    return np.array([np.sin(zenith) * np.sin(azimuth), np.sin(zenith) * np.cos(azimuth), np.cos(zenith)])


def sun_by_umbrage(program, latitude, longitude, *date_and_time):
    """The same, as the program prints it."""
    date, time = "%d-%02d-%02d" % date_and_time[:3], "%02d:%02d" % date_and_time[3:]
    words = [program, "sun", "--lat", str(latitude), "--lon", str(longitude), "--date", date, "--at", time, "--tz", "UTC", "--json"]
    return np.array(json.loads(subprocess.run(words, check=True, capture_output=True).stdout)["direction"])


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else "umbrage"
    chance = random.Random(1)
    worst = 0.0
    for _ in range(200):
        where = round(chance.uniform(-90, 90), 3), round(chance.uniform(-180, 180), 3)
        when = chance.randint(1972, 2040), chance.randint(1, 12), chance.randint(1, 28), chance.randint(0, 23), chance.randint(0, 59)
        apart = np.linalg.norm(sun_by_umbrage(program, *where, *when) - sun_by_erfa(*where, *when))
        worst = max(worst, float(np.degrees(apart)))
    print(f"200 places and times, 1972 to 2040: at most {worst:.6f} degrees apart")
    return 0 if worst <= 1e-4 else 1


sys.exit(main())
