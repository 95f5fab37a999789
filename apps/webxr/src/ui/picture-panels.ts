/** The panels with the cameras' pictures: name, age, and a button that hides each. */
import { type CameraView, type CameraViews, STALE_MS } from '../pictures/camera-views.ts';
import { elements } from './elements.ts';

interface Panel {
  view: CameraView;
  figure: HTMLElement;
  age: HTMLElement;
}

export class PicturePanels {
  readonly #views: CameraViews;
  #panels: Panel[] = [];

  constructor(views: CameraViews) {
    this.#views = views;
  }

  /** Other cameras, or others of them shown. */
  rebuild(): void {
    this.#panels = this.#views.views.map((view) => this.#make(view));
    elements.pictures.replaceChildren(...this.#panels.map(({ figure }) => figure));
    elements.pictures.hidden = this.#panels.length === 0;
    this.update(performance.now());
  }

  /** What changes with time; call a few times a second. */
  update(nowMs: number): void {
    for (const { view, figure, age } of this.#panels) {
      const ageMs = this.#views.ageMs(view, nowMs);
      const stale = ageMs !== null && ageMs > STALE_MS;
      const words = !view.shown ? 'hidden' : ageMs === null ? 'waiting' : ageWords(ageMs, stale);
      if (age.textContent !== words) age.textContent = words;
      figure.dataset.stale = String(view.shown && stale);
      view.canvas.hidden = !view.shown || ageMs === null;
    }
  }

  #make(view: CameraView): Panel {
    const figure = document.createElement('figure');
    figure.dataset.camera = String(view.camera);
    const caption = document.createElement('figcaption');
    const name = document.createElement('span');
    name.className = 'name';
    name.textContent = view.name;
    name.title = view.name;
    const age = document.createElement('span');
    age.className = 'age';
    const button = document.createElement('button');
    button.type = 'button';
    button.className = 'quiet';
    button.textContent = view.shown ? '–' : '+';
    button.ariaLabel = `${view.shown ? 'Hide' : 'Show'} ${view.name}`;
    button.addEventListener('click', () => {
      // A button that keeps the focus would take the space bar.
      button.blur();
      this.#views.toggle(view);
    });
    caption.append(name, age, button);
    figure.append(caption, view.canvas);
    return { view, figure, age };
  }
}

function ageWords(ageMs: number, stale: boolean): string {
  return stale ? `stale, ${(ageMs / 1000).toFixed(1)} s` : `${Math.round(ageMs / 10) * 10} ms`;
}
