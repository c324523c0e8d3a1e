//! Pitches as keys of the MIDI standard: 60 is middle C, and an octave has 12 keys.

use crate::{Scale, SoundOptions};

/// Middle C.
const MIDDLE: u8 = 60;

impl Scale {
    /// The keys of an octave above its lowest one.
    const fn tones(self) -> &'static [u8] {
        match self {
            Self::Pentatonic => &[0, 2, 4, 7, 9],
            Self::Major => &[0, 2, 4, 5, 7, 9, 11],
            Self::Minor => &[0, 2, 3, 5, 7, 8, 10],
            Self::Chromatic => &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11],
        }
    }
}

/// The pitches of a range of whole octaves about middle C, both ends included.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Range {
    tones: &'static [u8],
    octaves: usize,
    lowest: u8,
}

impl Range {
    pub(crate) fn new(options: &SoundOptions) -> Self {
        let octaves = options.bounded().octaves;
        Self { tones: options.scale.tones(), octaves: octaves.into(), lowest: MIDDLE - 12 * (octaves / 2) }
    }

    /// The key nearest to a place, from 0 (low) to 1.
    pub(crate) fn at(&self, place: f64) -> u8 {
        let degrees = self.octaves * self.tones.len();
        self.key((libm::round(place.clamp(0.0, 1.0) * degrees as f64) as usize).min(degrees))
    }

    /// The key of a letter, counted among those that draw.
    pub(crate) fn of_letter(&self, letter: usize, level: u32) -> u8 {
        let octave = (level as usize).min(self.octaves - 1);
        let above = (self.octaves - octave) * self.tones.len() + 1;
        self.key(octave * self.tones.len() + letter % above)
    }

    fn key(&self, degree: usize) -> u8 {
        let (octave, tone) = (degree / self.tones.len(), degree % self.tones.len());
        self.lowest + 12 * octave as u8 + self.tones[tone]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_of_the_scale_and_fill_the_range() {
        for (octaves, low, high) in [(1, 60, 72), (2, 48, 72), (3, 48, 84), (6, 24, 96)] {
            for scale in [Scale::Pentatonic, Scale::Major, Scale::Minor, Scale::Chromatic] {
                let range = Range::new(&SoundOptions { scale, octaves, ..SoundOptions::default() });
                let keys: Vec<u8> = (0..=1000).map(|place| range.at(f64::from(place) / 1000.0)).collect();
                assert!(keys.is_sorted() && keys.iter().all(|key| scale.tones().contains(&(key % 12))));
                assert_eq!((keys[0], keys[1000]), (low, high));
                let distinct = keys.windows(2).filter(|two| two[0] != two[1]).count() + 1;
                assert_eq!(distinct, usize::from(octaves) * scale.tones().len() + 1);
                assert!(
                    (0..40).all(|letter| (0..9).all(|level| (low..=high).contains(&range.of_letter(letter, level))))
                );
            }
        }
        let range = Range::new(&SoundOptions::default());
        assert_eq!([0.0, 0.5, 1.0, -3.0, f64::NAN].map(|place| range.at(place)), [48, 67, 84, 48, 48]);
        assert_eq!(
            [(0, 0), (1, 0), (0, 1), (5, 0)].map(|(letter, level)| range.of_letter(letter, level)),
            [48, 50, 60, 60]
        );
    }
}
