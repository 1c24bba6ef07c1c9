/** The texts of the page in both languages, taken as the built page takes them. */

import packed from "../../src/gruebler/page/static/texts.txt";
import { loadTexts } from "../src/language";

await loadTexts(packed);
