//! Trapezoidal speed along the path (thesis section 5.2), triangular where the path is too short for the feed.

/// Distance over time from rest to rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Profile {
    length: f64,
    acceleration: f64,
    peak: f64,
    ramp: f64,
    duration: f64,
}

impl Profile {
    /// From rest over `length` [m] to rest, at most `feed` [m/s] fast, speeding up and slowing down by `acceleration` [m/s^2].
    ///
    /// All three are positive. If the length does not suffice to reach the feed, the profile is a triangle.
    pub fn new(length: f64, feed: f64, acceleration: f64) -> Self {
        let peak = feed.min((length * acceleration).sqrt());
        let ramp = peak / acceleration;
        let duration = length / peak + ramp;
        Self { length, acceleration, peak, ramp, duration }
    }

    /// Time from rest to rest [s].
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// Highest speed [m/s].
    pub fn peak(&self) -> f64 {
        self.peak
    }

    /// Distance covered [m] and speed [m/s] at the time `t` [s]; at rest before the start and after the end.
    pub fn at(&self, t: f64) -> (f64, f64) {
        let left = self.duration - t;
        if t <= 0.0 {
            (0.0, 0.0)
        } else if left <= 0.0 {
            (self.length, 0.0)
        } else if t < self.ramp {
            (self.acceleration * t * t / 2.0, self.acceleration * t)
        } else if left < self.ramp {
            (self.length - self.acceleration * left * left / 2.0, self.acceleration * left)
        } else {
            (self.peak * (t - self.ramp / 2.0), self.peak)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_blend_is_met() {
        // golden.json, lspb_1_2_11steps: from 1 to 2 in 10 s at 0.15/s with acceleration 0.045/s^2 (tolerance 1e-8 there).
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
    fn distance_is_the_integral_of_speed() {
        let profile = Profile::new(0.3, 0.1, 0.2);
        let steps = 100_000;
        let dt = profile.duration() / steps as f64;
        let covered: f64 = (0..steps).map(|k| profile.at((k as f64 + 0.5) * dt).1 * dt).sum();
        assert!((covered - 0.3).abs() < 1e-9);
    }
}
