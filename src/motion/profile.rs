//! Trapezoidal speed along the path (thesis section 5.2), triangular if the path is too short to
//! reach the feed.

/// Distance over time along one move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Profile {
    length: f64,
    acceleration: f64,
    entry: f64,
    exit: f64,
    peak: f64,
    ramp_up: f64,
    ramp_down: f64,
    duration: f64,
}

impl Profile {
    /// From rest to rest over `length` [m], at no more than `feed` [m/s], accelerating and braking
    /// at `acceleration` [m/s^2].
    ///
    /// All three are positive. If the length is too short to reach the feed, the profile is a
    /// triangle.
    pub fn new(length: f64, feed: f64, acceleration: f64) -> Self {
        Self::between(length, (0.0, 0.0), feed, acceleration)
    }

    /// From the speed `entry` to the speed `exit` [m/s] over `length` [m].
    ///
    /// Both are at most the feed, and the length must suffice for the change between them.
    pub fn between(length: f64, (entry, exit): (f64, f64), feed: f64, acceleration: f64) -> Self {
        let top = (length * acceleration + (entry * entry + exit * exit) / 2.0).sqrt();
        // Rounding must not put the peak below the speeds at the ends.
        let peak = feed.min(top).max(entry).max(exit);
        let (ramp_up, ramp_down) = ((peak - entry) / acceleration, (peak - exit) / acceleration);
        let ramps = ramp_up * (peak + entry) / 2.0 + ramp_down * (peak + exit) / 2.0;
        let duration = ramp_up + ramp_down + (length - ramps).max(0.0) / peak;
        Self { length, acceleration, entry, exit, peak, ramp_up, ramp_down, duration }
    }

    /// Duration [s].
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// Highest speed [m/s].
    pub fn peak(&self) -> f64 {
        self.peak
    }

    /// Distance covered [m] and speed [m/s] at the time `t` [s], with the values of the start
    /// before it and those of the end after it.
    pub fn at(&self, t: f64) -> (f64, f64) {
        let left = self.duration - t;
        if t <= 0.0 {
            (0.0, self.entry)
        } else if left <= 0.0 {
            (self.length, self.exit)
        } else if t < self.ramp_up {
            (self.entry * t + self.acceleration * t * t / 2.0, self.entry + self.acceleration * t)
        } else if left < self.ramp_down {
            let speed = self.exit + self.acceleration * left;
            (self.length - self.exit * left - self.acceleration * left * left / 2.0, speed)
        } else {
            (self.ramp_up * (self.entry + self.peak) / 2.0 + self.peak * (t - self.ramp_up), self.peak)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_blend_is_met() {
        // golden.json, lspb_1_2_11steps: from 1 to 2 in 10 s at 0.15/s with acceleration 0.045/s^2
        // (tolerance 1e-8 there).
        let profile = Profile::new(1.0, 0.15, 0.045);
        assert!((profile.duration() - 10.0).abs() < 1e-12);
        let s = [0.0, 0.0225, 0.09, 0.2025, 0.35, 0.5, 0.65, 0.7975, 0.91, 0.9775, 1.0];
        let v = [0.0, 0.045, 0.09, 0.135, 0.15, 0.15, 0.15, 0.135, 0.09, 0.045, 0.0];
        for t in 0..=10 {
            let (distance, speed) = profile.at(t as f64);
            assert!((distance - s[t]).abs() < 1e-8, "distance at {t} s");
            assert!((speed - v[t]).abs() < 1e-8, "speed at {t} s");
        }
    }

    #[test]
    fn a_short_path_gives_a_triangle() {
        let profile = Profile::new(0.01, 0.1, 0.2);
        assert!((profile.peak() - 0.002f64.sqrt()).abs() < 1e-15);
        assert!((profile.duration() - 2.0 * profile.peak() / 0.2).abs() < 1e-12);
        let (half, peak) = profile.at(profile.duration() / 2.0);
        assert!((half - 0.005).abs() < 1e-12 && (peak - profile.peak()).abs() < 1e-9);
        assert_eq!(profile.at(profile.duration()), (0.01, 0.0));
    }

    #[test]
    fn a_short_path_between_two_speeds_is_a_triangle_too() {
        // v^2 = v_0^2 + 2 a s: from 0.1 m/s up to 0.5 in 0.12 m, from there down to 0.3 in 0.08 m,
        // at 1 m/s^2.
        let profile = Profile::between(0.2, (0.1, 0.3), 1.0, 1.0);
        assert!((profile.peak() - 0.5).abs() < 1e-15 && (profile.duration() - 0.6).abs() < 1e-15);
        let (distance, speed) = profile.at(0.4);
        assert!((distance - 0.12).abs() < 1e-15 && (speed - 0.5).abs() < 1e-15);
    }

    #[test]
    fn distance_is_the_integral_of_speed() {
        for ends in [(0.0, 0.0), (0.05, 0.0), (0.02, 0.1), (0.1, 0.1)] {
            integral(Profile::between(0.3, ends, 0.1, 0.2), ends);
        }
    }

    fn integral(profile: Profile, (entry, exit): (f64, f64)) {
        assert_eq!((profile.at(0.0).1, profile.at(profile.duration()).1), (entry, exit));
        let steps = 100_000;
        let dt = profile.duration() / steps as f64;
        let covered: f64 = (0..steps).map(|k| profile.at((k as f64 + 0.5) * dt).1 * dt).sum();
        assert!((covered - 0.3).abs() < 1e-9);
    }
}
