/** Pictures and clips of the view. */
export const capture = {
  notLive: 'NOT LIVE',
  stopped: 'EMERGENCY STOP',
  noRobot: 'no robot',
  picture: 'Picture',
  pictureTitle: 'Save a picture of the view',
  pictureSaved: 'A picture of the view was saved.',
  pictureFailed: 'This browser could not save a picture of the view.',
  clip: 'Clip',
  clipTitle: 'Save a clip of the last 30 seconds',
  inVr: 'Pictures and clips show the page’s own view: leave the headset’s view first.',
  clipsOff: 'No clip is kept: switch on “Keep the last 30 s for a clip” in the settings.',
  clipEmpty: 'There is nothing in the clip yet.',
  clipUnavailable: 'This browser cannot encode video, so it keeps no clips.',
  clipStopped: (detail: string) => `No clip is kept any more: ${detail}`,
  clipFailed: 'This browser could not save the clip.',
  /** @param missing seconds in between that it does not show */
  clipSaved: (seconds: number, missing: number) =>
    `A clip of ${seconds} s was saved.${missing === 0 ? '' : ` It lacks ${missing} s in which this page drew nothing, for example while it was hidden.`}`,
  keep: 'Keep the last 30 s for a clip',
  keepHint:
    'Encodes the view all the time: takes processor time and up to 32 MB of memory. Leave it off on a computer without a graphics processor.',
};
