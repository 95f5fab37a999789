/** What the headset says about its views. */
import type { Hand, HeadsetView } from '../ground/headset-settings.ts';
import { texts } from './language.ts';

/** A view's name within a sentence. */
export function viewName(view: HeadsetView): string {
  return texts().headset.viewNames[view];
}

/** Told when a view begins. */
export function viewNotice(view: HeadsetView): string {
  return texts().headset.viewBegins[view];
}

/** What the hands do in a view. @param driveHand the hand that drives */
export function viewHint(view: HeadsetView, driveHand: Hand): string {
  const { tabletopHint, turnHint, hands } = texts().headset;
  return view === 'tabletop' ? tabletopHint(hands[driveHand]) : turnHint(hands[driveHand]);
}

/** The view, unless it is the usual one. @param scale metres in the room of one metre of the world */
export function viewFact(view: HeadsetView, scale: number): string | null {
  if (view === 'first-person') return null;
  const name = texts().headset.views[view];
  return view === 'tabletop' ? `${name} 1:${Math.round(1 / scale)}` : name;
}
