//! A mix that meets a budget, found by trying: the way out where what tiles cost is learnt too slowly.

/// Places on the ladder of rungs, finest first, that one frame was coded at, and what it cost there. Whole numbers are
/// rungs, what is between them a split into both.
pub(crate) struct PlaceSearch {
    /// Bytes to come near to.
    wanted: usize,
    coarsest: f32,
    /// The coarsest place that was too dear.
    over: Option<(f32, usize)>,
    /// The finest that was not.
    under: Option<(f32, usize)>,
    /// How far to go on where all were too dear, or none.
    step: f32,
    latest: Option<f32>,
    /// The latest two were on one side.
    again: bool,
}

/// It doubles with each.
const FIRST_STEP: f32 = 1.0;
/// Places closer than this are one.
const LEAST_GAP: f32 = 1e-3;

impl PlaceSearch {
    pub fn new(wanted: usize, coarsest: f32) -> Self {
        Self { wanted, coarsest, over: None, under: None, step: FIRST_STEP, latest: None, again: false }
    }

    /// What the frame cost.
    pub fn note(&mut self, place: f32, bytes: usize) {
        let too_dear = bytes > self.wanted;
        let side = if too_dear { self.over } else { self.under };
        self.again = side.is_some_and(|(last, _)| self.latest == Some(last));
        self.latest = Some(place);
        if too_dear {
            self.over = Some((place, bytes));
            self.under = self.under.filter(|(under, _)| *under > place);
        } else {
            self.under = Some((place, bytes));
            self.over = self.over.filter(|(over, _)| *over < place);
        }
    }

    /// Where to try next, at first `from`. `None` where the ladder has no such place.
    pub fn next(&mut self, from: f32) -> Option<f32> {
        let (known, place) = match (self.over, self.under) {
            (None, None) => return Some(from.clamp(0.0, self.coarsest)),
            (Some((over, most)), Some((under, least))) => {
                // In proportion, or halfway where that closes in from one side alone.
                let share = (most - self.wanted) as f32 / (most - least) as f32;
                let between = over + (under - over) * if self.again { 0.5 } else { share };
                return (under - over >= LEAST_GAP).then_some(between);
            }
            (Some((over, _)), None) => (over, over + self.step),
            (None, Some((under, _))) => (under, under - self.step),
        };
        self.step *= 2.0;
        // At an end of the ladder there is no farther place.
        let place = place.clamp(0.0, self.coarsest);
        (place != known).then_some(place)
    }
}

#[cfg(test)]
mod tests {
    use super::PlaceSearch;

    /// Tries until the cost is within 2 %, or there is nowhere to go.
    fn search(wanted: usize, from: f32, cost: impl Fn(f32) -> usize) -> (Vec<f32>, Option<usize>) {
        let mut search = PlaceSearch::new(wanted, 25.0);
        let mut places = Vec::new();
        while let Some(place) = search.next(from) {
            assert!((0.0..=25.0).contains(&place) && places.len() < 40);
            places.push(place);
            let bytes = cost(place);
            if bytes.abs_diff(wanted) * 50 <= wanted {
                return (places, Some(bytes));
            }
            search.note(place, bytes);
        }
        (places, None)
    }

    fn even(place: f32) -> usize {
        (10_000.0 * 0.9_f32.powf(place)) as usize
    }

    #[test]
    fn finds_a_place_from_anywhere() {
        for from in [0.0, 3.3, 12.0, 25.0] {
            for wanted in [800, 1000, 3000, 9900] {
                let (places, bytes) = search(wanted, from, even);
                assert!(bytes.is_some() && places.len() <= 10, "{wanted} from {from}: {places:?}");
            }
        }
    }

    #[test]
    fn ends_at_either_end_of_the_ladder() {
        let (places, bytes) = search(20_000, 5.0, even);
        assert_eq!((places.last(), bytes), (Some(&0.0), None));
        let (places, bytes) = search(100, 5.0, even);
        assert_eq!((places.last(), bytes), (Some(&25.0), None));
    }

    #[test]
    fn ends_where_costs_leap_over_what_is_wanted() {
        let (places, bytes) = search(2000, 5.0, |place| if place < 7.3 { 3000 } else { 1000 });
        assert_eq!(bytes, None);
        assert!((places.last().expect("a place") - 7.3).abs() < 0.01, "{places:?}");
    }
}
