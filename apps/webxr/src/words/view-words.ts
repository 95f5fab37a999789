/** Says whether what is shown is where the robot reported itself, or a prediction. */
import type { PredictionState } from '@farpoint/operator/prediction';

/** What the page says of the view. */
export interface ViewFigures {
  /** Why it is predicted, or not; `off`: the operator has switched it off. */
  state: PredictionState | 'off';
  /** How much later than the newest report the shown pose is, ms; 0 where it is as reported. */
  aheadMs: number;
}

export function viewWords({ state, aheadMs }: ViewFigures): string {
  switch (state) {
    case 'predicted':
      return `Predicted ${tens(aheadMs)} ms ahead`;
    case 'off':
      return 'As reported: prediction is off (P)';
    case 'held':
      return 'As reported: the robot is held';
    case 'stale':
      return 'As reported: nothing new is heard';
    default:
      return 'As reported';
  }
}

/** For the wrist panel, after the link's figures. */
export function viewLead(view: ViewFigures | undefined): string {
  return view?.state === 'predicted' ? `  view +${tens(view.aheadMs)} ms predicted` : '';
}

/** What a key has done. */
export function predictionWords(on: boolean): string {
  return on
    ? 'The view is led by your commands: a prediction, corrected by the robot.'
    : 'The view shows where the robot last reported itself.';
}

/** It changes with every frame: the tens are enough. */
function tens(ms: number): number {
  return Math.round(ms / 10) * 10;
}
