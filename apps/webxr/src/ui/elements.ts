/** The page's elements by id. The type of each is checked once. */
function byId<T extends HTMLElement>(id: string, kind: new () => T): T {
  const element = document.getElementById(id);
  if (!(element instanceof kind)) throw new Error(`the page has no <${kind.name}> with id ${id}`);
  return element;
}

export const elements = {
  stage: byId('stage', HTMLCanvasElement),
  cameraStage: byId('camera-stage', HTMLElement),
  bar: byId('bar', HTMLElement),
  link: byId('link', HTMLElement),
  view: byId('view', HTMLButtonElement),
  vr: byId('vr', HTMLButtonElement),
  vrReason: byId('vr-reason', HTMLElement),
  dashboardOpen: byId('dashboard-open', HTMLButtonElement),
  dashboard: byId('dashboard', HTMLElement),
  alarm: byId('alarm', HTMLButtonElement),
  settingsOpen: byId('settings-open', HTMLButtonElement),
  settings: byId('settings', HTMLDialogElement),
  robotSwitch: byId('robot-switch', HTMLSelectElement),
  disconnect: byId('disconnect', HTMLButtonElement),
  robots: byId('robots', HTMLElement),
  robotList: byId('robot-list', HTMLUListElement),
  robotsEmpty: byId('robots-empty', HTMLElement),
  hud: byId('hud', HTMLElement),
  facts: byId('facts', HTMLElement),
  sensors: byId('sensors', HTMLElement),
  sound: byId('sound', HTMLElement),
  clouds: byId('clouds', HTMLElement),
  pictures: byId('pictures', HTMLElement),
  notice: byId('notice', HTMLElement),
  drive: byId('drive', HTMLElement),
  joystick: byId('joystick', HTMLElement),
  knob: byId('knob', HTMLElement),
  holder: byId('holder', HTMLElement),
  take: byId('take', HTMLButtonElement),
  release: byId('release', HTMLButtonElement),
  talk: byId('talk', HTMLButtonElement),
  talkState: byId('talk-state', HTMLElement),
  latency: byId('latency', HTMLButtonElement),
  estop: byId('estop', HTMLButtonElement),
  estopRelease: byId('estop-release', HTMLButtonElement),
  failure: byId('failure', HTMLElement),
};
