/** Whether what was seen is remembered; and buttons that forget, save and load it. */
import { MemoryFileError, POINT_FILE_FORMATS, type PointFileFormat } from '@farpoint/operator';
import { effect } from '@preact/signals-core';
import type { CloudAppearance } from '../../state/cloud-appearance.ts';
import { quietButton, rowOf, selectOf } from './panel-parts.ts';
import type { RememberedWorld } from './remembered-world.ts';

export interface MemoryControlsParts {
  readonly remembered: Pick<RememberedWorld, 'forget' | 'save' | 'load'>;
  tell(text: string, tone: 'good' | 'warning'): void;
}

export function memoryControls(
  { memory, remembers }: CloudAppearance,
  { remembered, tell }: MemoryControlsParts,
): HTMLElement {
  const toggle = quietButton('Memory', 'Remember what was seen: dimmer where it is not seen now', () => {
    memory.value = !remembers.peek();
  });
  const forget = quietButton('Forget', 'Forget everything that was seen until now', () =>
    remembered.forget(),
  );
  const save = quietButton('Save', 'Save what is remembered as a point cloud', () => void saveFile());
  const load = quietButton('Load', 'Add a point cloud (PLY or PCD) to what is remembered', () =>
    input.click(),
  );
  let format: PointFileFormat = 'ply';
  const formats = selectOf('Format of the file', POINT_FILE_FORMATS, (chosen) => {
    format = chosen;
  });
  const input = document.createElement('input');
  Object.assign(input, { type: 'file', accept: '.ply,.pcd', hidden: true });
  input.ariaLabel = 'Point cloud to remember';
  const group = document.createElement('div');
  const file = rowOf('File', save, load, input);
  const as = rowOf('Save as', formats);
  const anew = rowOf('Anew', forget);
  input.addEventListener('change', () => void loadFile(input.files?.[0]));
  effect(() => {
    toggle.ariaPressed = String(remembers.value);
    for (const row of [file, as, anew]) row.hidden = !remembers.value;
  });
  group.append(rowOf('Keep', toggle), file, as, anew);
  return group;

  async function saveFile(): Promise<void> {
    const bytes = await remembered.save(format);
    if (bytes === null) return;
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([bytes], { type: 'application/octet-stream' }));
    link.download = `farpoint-${new Date().toISOString().slice(0, 19).replaceAll(':', '-')}.${format.slice(0, 3)}`;
    link.click();
    URL.revokeObjectURL(link.href);
  }

  async function loadFile(file: File | undefined): Promise<void> {
    input.value = '';
    if (file === undefined) return;
    try {
      const points = await remembered.load(file);
      tell(`${points.toLocaleString('en')} points loaded from ${file.name}`, 'good');
    } catch (error) {
      if (!(error instanceof MemoryFileError)) throw error;
      tell(`${file.name} cannot be loaded: ${error.message}`, 'warning');
    }
  }
}
