/** What the page says about a saved picture of the scene. */
export const sceneWords = {
  saved: 'The picture of the scene was saved.',
  savedOld: 'The picture of the scene was saved: it is the last before the link was lost.',
  inVr: 'The picture of the scene is saved on a flat screen only: leave the headset’s view first.',
  noRobot: 'Choose a robot first: there is no scene yet.',
  failed: 'This browser could not save the picture.',
} as const;
