/** The pages of the headset's menu: what can be chosen now, and what each entry does. Pure. */
import type { LeaseState, RobotListing } from '@farpoint/operator';
import { HEADSET_VIEWS, type HeadsetView } from '../../ground/headset-settings.ts';
import { hasCommands } from '../../state/commands-state.ts';
import { viewName } from '../../words/headset-words.ts';
import { laterTexts, texts } from '../../words/language.ts';
import type { Words } from '../../words/words.ts';
import type { ConsoleActions } from './console-actions.ts';
import { commandPages, type MenuCommands } from './menu-commands.ts';
import type { MenuItem, MenuPageName, MenuPlace } from './menu-item.ts';

export interface MenuCamera {
  readonly name: string;
  readonly shown: 'hidden' | 'shown' | 'enlarged' | 'filling';
}

export interface MenuFacts {
  /** There is a session. */
  readonly live: boolean;
  /** The robot hears: otherwise nothing can be asked or answered. */
  readonly heard: boolean;
  readonly latched: boolean;
  readonly robots: readonly Pick<RobotListing, 'id' | 'name'>[];
  /** Why no robot is listed, or nothing to connect to. */
  readonly noRobots: string;
  readonly chosenRobotId: string | null;
  readonly holder: LeaseState['holder'];
  readonly mayTake: boolean;
  readonly mayAsk: boolean;
  /** Another operator asks for the drive or offers it; `null` if none does. */
  readonly asked: MenuRequest | null;
  /** What this operator has asked for or offered; `null` if nothing waits. */
  readonly own: Pick<MenuRequest, 'id' | 'text'> | null;
  /** Whether anybody is here to whom the drive could be handed, and to whom it may be offered now. */
  readonly hasHeirs: boolean;
  readonly heirs: readonly { readonly number: number; readonly text: string }[];
  readonly view: HeadsetView;
  readonly cameras: readonly MenuCamera[];
  readonly commands: MenuCommands;
  /** Others see where this operator points. */
  readonly mayPoint: boolean;
  /** Alarms, then what the robot reports. */
  readonly readings: readonly Words[];
  /** Where the time goes, line by line. */
  readonly times: { readonly clouds: readonly Words[]; readonly commands: readonly Words[] };
  /** The operator's own room is behind the scene. */
  readonly passthrough: boolean;
}

/** With an answer's two words. */
export interface MenuRequest {
  readonly id: number;
  readonly text: string;
  readonly accept: string;
  readonly refuse: string;
}

export interface MenuPage {
  readonly title: string;
  readonly items: readonly MenuItem[];
}

/** Entries of a list on one page. Chosen: with two rows each they fit on the plate; menu-page.test.ts holds it. */
const LISTED = 6;

export function menuPage(facts: MenuFacts, { page, first }: MenuPlace): MenuPage {
  const said = laterTexts().headsetMenu;
  switch (page) {
    case 'main':
      return { title: said.title, items: mainItems(facts) };
    case 'robots':
      return { title: said.robots, items: [...robotItems(facts, first), back()] };
    case 'people':
      return { title: said.handOver, items: [...heirItems(facts, first), back()] };
    case 'views':
      return { title: said.view, items: [...viewItems(facts), back()] };
    case 'cameras':
      return { title: said.cameras, items: [...cameraList(facts, first), back()] };
    case 'camera':
      return cameraPage(facts, first);
    case 'commands':
      return { title: texts().commands.title, items: [...commandItems(facts, first), back()] };
    case 'readings': {
      const lines = paged(facts.readings.map(line), 'readings', first);
      const none: MenuItem[] = lines.length === 0 ? [{ text: said.noReadings, choice: null }] : [];
      return { title: said.readings, items: [...lines, ...none, back()] };
    }
    case 'times':
      return { title: said.times, items: first === 0 ? cloudTimes(facts) : commandTimes(facts) };
  }
}

function act(text: string, work: (actions: ConsoleActions) => void, closes = true): MenuItem {
  return { text, choice: { act: work, closes } };
}

function open(text: string, page: MenuPageName, first = 0): MenuItem {
  return { text: `${text} ›`, choice: { page, first } };
}

function back(to: MenuPageName = 'main'): MenuItem {
  return { text: `‹ ${laterTexts().headsetMenu.back}`, choice: { page: to, first: 0 } };
}

function line({ text, tone }: Words): MenuItem {
  return { text, choice: null, tone };
}

/** So many of a list as fit on a page, from `first` on, and an entry that shows those after them. */
function paged(all: readonly MenuItem[], page: MenuPageName, first: number): MenuItem[] {
  const from = first < all.length ? first : 0;
  const shown = all.slice(from, from + LISTED);
  if (all.length <= LISTED) return shown;
  return [...shown, open(laterTexts().headsetMenu.more, page, from + LISTED)];
}

function mainItems(facts: MenuFacts): MenuItem[] {
  const said = laterTexts().headsetMenu;
  const { chosenRobotId, live, view, cameras, passthrough, asked, own } = facts;
  return [
    ...(live ? [stopItem(facts)] : []),
    ...(live ? requestItems(facts) : []),
    open(said.robots, 'robots'),
    ...(live ? driveItems(facts) : []),
    ...(live && hasCommands(facts.commands.groups, facts.commands.recording)
      ? [open(texts().commands.title, 'commands')]
      : []),
    ...(facts.mayPoint ? [act(said.point, (actions) => actions.pointAtFloor())] : []),
    open(said.viewNow(viewName(view)), 'views'),
    ...(cameras.length === 0 ? [] : [open(said.cameras, 'cameras')]),
    ...(live ? [open(said.readings, 'readings'), open(said.times, 'times')] : []),
    act(said.recentre, (actions) => actions.recentre()),
    ...(chosenRobotId === null ? [] : [act(said.disconnect, (actions) => actions.disconnect())]),
    act(passthrough ? said.leave.ar : said.leave.vr, (actions) => actions.leave()),
    // With both questions there is no room for it; A and X close the menu, too.
    ...(asked !== null && own !== null ? [] : [act(said.close, () => undefined)]),
  ];
}

function stopItem({ latched }: MenuFacts): MenuItem {
  const said = laterTexts().headsetMenu;
  return { ...act(latched ? said.stopAgain : said.stop, (actions) => actions.stop()), tone: 'bad' };
}

/** What others want, and what this operator waits for. Nothing can be answered to a robot that does not hear. */
function requestItems({ asked, own, heard }: MenuFacts): MenuItem[] {
  const items: MenuItem[] = [];
  if (asked !== null) {
    const { id, text, accept, refuse } = asked;
    items.push({ text, choice: null, tone: 'warning' });
    if (heard)
      items.push(
        act(accept, (actions) => actions.answer(id, true)),
        act(refuse, (actions) => actions.answer(id, false)),
      );
  }
  if (own !== null) {
    items.push({ text: own.text, choice: null });
    if (heard) items.push(act(laterTexts().headsetMenu.takeBack, (actions) => actions.withdraw(own.id)));
  }
  return items;
}

function driveItems({ holder, mayTake, mayAsk, hasHeirs }: MenuFacts): MenuItem[] {
  const said = laterTexts().headsetMenu;
  if (holder === 'you')
    return hasHeirs ? [open(said.handOver, 'people')] : [act(said.giveUp, (actions) => actions.giveUp())];
  return [
    ...(mayAsk ? [act(said.ask, (actions) => actions.askToDrive())] : []),
    ...(mayTake ? [act(said.takeOver, (actions) => actions.takeOver())] : []),
  ];
}

function heirItems({ heirs }: MenuFacts, first: number): MenuItem[] {
  const said = laterTexts().headsetMenu;
  const offers = heirs.map(({ number, text }) =>
    act(said.offerTo(text), (actions) => actions.offerDrive(number)),
  );
  return [...paged(offers, 'people', first), act(said.giveUp, (actions) => actions.giveUp())];
}

function robotItems({ robots, chosenRobotId, noRobots }: MenuFacts, first: number): MenuItem[] {
  const said = laterTexts().headsetMenu;
  const away: MenuItem[] =
    chosenRobotId === null || robots.some(({ id }) => id === chosenRobotId)
      ? []
      : [{ text: said.offline(chosenRobotId), choice: null, tone: 'chosen' }];
  const listed = robots.map(({ id, name }): MenuItem => {
    // It stays open: the list shows what becomes of it.
    const item = act(said.robot(name, id === chosenRobotId), (actions) => actions.choose(id), false);
    return id === chosenRobotId ? { ...item, choice: null, tone: 'chosen' } : item;
  });
  const none: MenuItem[] = robots.length === 0 ? [{ text: noRobots, choice: null }] : [];
  return [...paged([...away, ...listed], 'robots', first), ...none];
}

function commandItems({ commands }: MenuFacts, page: number): MenuItem[] {
  const pages = commandPages(commands);
  const shown = pages[page] ?? pages[0] ?? [];
  const next = page + 1 < pages.length ? page + 1 : 0;
  return [...shown, ...(pages.length > 1 ? [open(laterTexts().headsetMenu.more, 'commands', next)] : [])];
}

function cloudTimes({ live, times }: MenuFacts): MenuItem[] {
  const said = laterTexts().headsetMenu;
  const test = live ? [act(said.latency, (actions) => actions.testLatency())] : [];
  return [...test, ...times.clouds.map(line), open(said.commands, 'times', 1), back()];
}

function commandTimes({ times }: MenuFacts): MenuItem[] {
  return [...times.commands.map(line), back('times')];
}

function viewItems({ view }: MenuFacts): MenuItem[] {
  return HEADSET_VIEWS.map((each): MenuItem => {
    const item = act(viewName(each), (actions) => actions.show(each));
    return each === view ? { ...item, tone: 'chosen' } : item;
  });
}

function cameraList({ cameras }: MenuFacts, first: number): MenuItem[] {
  const said = laterTexts().headsetMenu;
  return paged(
    cameras.map(({ name, shown }, camera) => open(said.camera[shown](name), 'camera', camera)),
    'cameras',
    first,
  );
}

/** The entries of a camera stay open: one sees what they do beside the menu. */
function cameraPage({ cameras }: MenuFacts, camera: number): MenuPage {
  const said = laterTexts().headsetMenu;
  const found = cameras[camera];
  if (found === undefined) return { title: said.cameras, items: [back('cameras')] };
  const { name, shown } = found;
  const toggle = act(
    shown === 'hidden' ? said.cameraShow : said.cameraHide,
    (actions) => actions.toggleCamera(camera),
    false,
  );
  const sizes = [
    shown === 'enlarged'
      ? act(said.cameraShrink, (actions) => actions.enlarge(camera), false)
      : act(said.cameraEnlarge, (actions) => actions.enlarge(camera), false),
    shown === 'filling'
      ? act(said.cameraShrink, (actions) => actions.fill(camera), false)
      : act(said.cameraFill, (actions) => actions.fill(camera), false),
  ];
  return { title: name, items: [toggle, ...(shown === 'hidden' ? [] : sizes), back('cameras')] };
}
