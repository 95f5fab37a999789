/** The buttons of the event log that save the view: for hands without a keyboard. */
import { texts } from '../../words/language.ts';
import { followKey } from '../ui/key-title.ts';
import { quietButton } from '../ui/panel-parts.ts';

export interface Capturing {
  /** Saves a picture of the view. */
  picture(): void;
  /** Saves a clip of the last 30 seconds. */
  clip(): void;
}

export function captureButtons(capture: Capturing): HTMLButtonElement[] {
  const { picture, pictureTitle, clip, clipTitle } = texts().capture;
  const ofPicture = quietButton(picture, pictureTitle, () => capture.picture());
  const ofClip = quietButton(clip, clipTitle, () => capture.clip());
  followKey(ofPicture, 'picture');
  followKey(ofClip, 'clip');
  return [ofPicture, ofClip];
}
