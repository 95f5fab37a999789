/** Lines between the operators of one robot, folded away until they are wanted. */
import type { HeardLine, PeopleRequests } from '@farpoint/operator';
import { computed, effect } from '@preact/signals-core';
import type { PageState } from '../state/page-state.ts';
import { nameWords } from '../status/handover-words.ts';
import { keepInRoom } from './controls-room.ts';
import { elements } from './elements.ts';

export function showChat(state: PageState, requests: PeopleRequests): void {
  const { people, robot } = state;
  const { chat, chatUnread, chatLines, chatForm, chatText } = elements;
  keepInRoom(chat);
  // To be scrolled by keys.
  chatLines.tabIndex = 0;
  // Whoever is alone has nobody to talk to.
  const isWanted = computed(
    () => (robot.operators.value?.operators.length ?? 0) > 1 || people.lines.value.length > 0,
  );
  effect(() => {
    chat.hidden = !isWanted.value;
  });
  effect(() => {
    const unread = people.unread.value;
    const text = unread === 0 ? '' : `${unread} new`;
    if (chatUnread.textContent !== text) chatUnread.textContent = text;
    chatUnread.hidden = unread === 0;
  });
  let newest = 0;
  effect(() => {
    const lines = people.lines.value;
    const last = lines.at(-1)?.number ?? 0;
    // Another session, or a robot that counts anew.
    if (last < newest || lines.length === 0) chatLines.replaceChildren();
    const known = chatLines.children.length === 0 ? 0 : newest;
    // Only what is new is announced.
    for (const line of lines) if (line.number > known) chatLines.append(itemOf(line));
    while (chatLines.children.length > lines.length) chatLines.firstElementChild?.remove();
    newest = last;
    chatLines.scrollTop = chatLines.scrollHeight;
  });
  chat.addEventListener('toggle', () => {
    people.isChatOpen = chat.open;
    if (chat.open) chatLines.scrollTop = chatLines.scrollHeight;
  });
  chatForm.addEventListener('submit', (event) => {
    event.preventDefault();
    const text = chatText.value.trim();
    if (text !== '' && requests.say(text)) chatText.value = '';
  });
}

/** Text only: whatever an operator writes stays text. */
function itemOf({ from, yours, text, saidAtMs }: HeardLine): HTMLElement {
  const item = document.createElement('p');
  const [time, name] = [document.createElement('time'), document.createElement('b')];
  const said = new Date(Date.now() - (performance.now() - saidAtMs));
  time.textContent = said.toLocaleTimeString([], { hour: '2-digit', minute: '2-digit' });
  name.textContent = yours ? 'You' : nameWords(from);
  item.append(time, ' ', name, ` ${text}`);
  return item;
}
