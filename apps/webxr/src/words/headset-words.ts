/** What the headset says about its views. */
import type { Hand, HeadsetView } from '../ground/headset-settings.ts';

const HEADSET_VIEW_WORDS: Readonly<Record<HeadsetView, string>> = {
  'first-person': 'First person',
  'over-shoulder': 'Over the shoulder',
  tabletop: 'Tabletop',
};

/** Told when a view begins. */
export function viewNotice(view: HeadsetView): string {
  return `View in the headset: ${HEADSET_VIEW_WORDS[view].toLowerCase()}`;
}

/** What the hands do in a view. @param driveHand the hand that drives */
export function viewHint(view: HeadsetView, driveHand: Hand): string {
  const drive = `squeeze ${driveHand}: drive`;
  return view === 'tabletop'
    ? `Trigger: move · both: turn, scale · ${drive}`
    : `Other stick: turn · ${drive}`;
}

/** The view, unless it is the usual one. @param scale metres in the room of one metre of the world */
export function viewFact(view: HeadsetView, scale: number): string | null {
  if (view === 'first-person') return null;
  return view === 'tabletop'
    ? `${HEADSET_VIEW_WORDS[view]} 1:${Math.round(1 / scale)}`
    : HEADSET_VIEW_WORDS[view];
}
