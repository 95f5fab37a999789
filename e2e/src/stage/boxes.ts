/** Where the page's parts are: boxes only, no pixels. */
import { expect, type Page } from '@playwright/test';

/** What a hand uses or an eye must find. None may cover another, and each is entirely on the screen. */
const KEPT = [
  '#bar button, #bar select, #bar #link',
  '#drive button, #drive input, #joystick, #holder, #motion-state, #obstacle-guard, #drive-hint, #minimap, #near',
  '#sensors button, #sound button, #clouds .heads button, #clouds .legend, #clouds .controls',
  '#about, #handover, #handover button, #facts, #facts-fold, #no-gpu, #people, #commands, #alarm, #pictures, #pictures figure button, #dashboard',
  '#stop button, #stop-band, #banner, #notice, #stop-state, #tour, #tour button',
  '#robots, #obstacle, #failure',
].join(', ');

interface Faults {
  off: string[];
  covering: string[];
  /** What is hit at the middle of each button that may be pressed, where that is not the button. */
  hidden: string[];
  /** How much wider than the screen the page is, CSS pixels. */
  overflow: number;
  seen: string[];
}

/** What is only read, and only for a while or also elsewhere: a panel that somebody has opened may be there instead. */
const ONLY_READ = ['notice', 'stop-state', 'holder'];

/**
 * @param hasOpened whether somebody has opened a panel
 * @returns the names of what is on the screen
 */
export async function expectNothingCovered(page: Page, what: string, hasOpened = false): Promise<string[]> {
  const { seen, ...faults } = await page.evaluate(
    ([kept, onlyRead]): Faults => {
      const { clientWidth, clientHeight, scrollWidth } = document.documentElement;
      const boxes = [...document.querySelectorAll<HTMLElement>(kept)]
        .filter((element) => element.checkVisibility({ visibilityProperty: true }))
        .map((element) => ({
          element,
          name: element.id || `${element.className || element.tagName} ${element.textContent}`.slice(0, 40),
          box: element.getBoundingClientRect(),
        }))
        .filter(({ box }) => box.width > 0 && box.height > 0);
      const isOff = ({ left, top, right, bottom }: DOMRect) =>
        left < -0.5 || top < -0.5 || right > clientWidth + 0.5 || bottom > clientHeight + 0.5;
      // What stands in a column that can be scrolled may be below its end.
      const isScrolled = (element: HTMLElement) => {
        for (let each = element.parentElement; each !== null; each = each.parentElement)
          if (each.scrollHeight > each.clientHeight + 1 && getComputedStyle(each).overflowY !== 'visible')
            return each !== document.documentElement && each !== document.body;
        return false;
      };
      const off = boxes
        .filter(({ box, element }) => isOff(box) && !isScrolled(element))
        .map(({ name }) => name);
      const covering: string[] = [];
      for (const [i, one] of boxes.entries())
        for (const other of boxes.slice(i + 1)) {
          if (one.element.contains(other.element) || other.element.contains(one.element)) continue;
          if (isScrolled(one.element) || isScrolled(other.element)) continue;
          // Both are only read, and a notice goes after some seconds.
          if ([one.name, other.name].sort().join() === 'near,notice') continue;
          if (onlyRead.includes(one.name) || onlyRead.includes(other.name)) continue;
          const isApart =
            one.box.right <= other.box.left + 0.5 ||
            other.box.right <= one.box.left + 0.5 ||
            one.box.bottom <= other.box.top + 0.5 ||
            other.box.bottom <= one.box.top + 0.5;
          if (!isApart) covering.push(`${one.name} and ${other.name}`);
        }
      const hidden = boxes.flatMap(({ element, name, box }) => {
        if (!(element instanceof HTMLButtonElement) || isOff(box) || isScrolled(element)) return [];
        const hit = document.elementFromPoint(box.left + box.width / 2, box.top + box.height / 2);
        return element.contains(hit) ? [] : [`${name} is under ${hit?.id || hit?.className}`];
      });
      return {
        off,
        covering,
        hidden,
        overflow: scrollWidth - clientWidth,
        seen: boxes.map(({ name }) => name),
      };
    },
    [KEPT, hasOpened ? ONLY_READ : []] as const,
  );
  expect(faults, what).toEqual({ off: [], covering: [], hidden: [], overflow: 0 });
  return seen;
}
