/** Says whether what is shown is where the robot reported itself, or a prediction. */
import type { PredictionState } from '@farpoint/operator/prediction';
import { texts } from './language.ts';

/** What the page says of the view. */
export interface ViewFigures {
  /** Why it is predicted, or not; `off`: the operator has switched it off. */
  state: PredictionState | 'off';
  /** How much later than the newest report the shown pose is, ms; 0 where it is as reported. */
  aheadMs: number;
}

export function viewWords({ state, aheadMs }: ViewFigures): string {
  const said = texts().motion.view;
  switch (state) {
    case 'predicted':
      return said.predicted(tens(aheadMs));
    case 'off':
    case 'held':
    case 'stale':
      return said[state];
    default:
      return said.reported;
  }
}

/** For the wrist panel, after the link's figures. */
export function viewLead(view: ViewFigures | undefined): string {
  return view?.state === 'predicted' ? texts().motion.view.lead(tens(view.aheadMs)) : '';
}

/** What a key has done. */
export function predictionWords(on: boolean): string {
  const said = texts().motion.view;
  return on ? said.on : said.switchedOff;
}

/** It changes with every frame: the tens are enough. */
function tens(ms: number): number {
  return Math.round(ms / 10) * 10;
}
