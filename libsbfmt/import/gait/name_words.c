/* Finds words in the names of bones, objects and clips. A name is split into pieces at capitals, digits
 * and punctuation. A listed word matches a piece or the end of one ("upperleg"). Scripts without such
 * pieces are searched for substrings. */
#include <ctype.h>
#include <string.h>

#include "import/gait/locomotion.h"

enum { LONGEST_NAME = 256, MIN_SUFFIX = 3 };

typedef struct word_list {
  sbfi_word word;
  const char *pieces; /* separated by single spaces */
  const char *inside; /* matched anywhere; NULL if none */
} word_list;

static const word_list lists[] = {
    {SBFI_WORD_LEG,
        " leg legs thigh shin calf knee foot feet toe toes ankle hoof hooves paw femur tibia tarsus upleg "
        "lowleg foreleg hindleg bein beine oberschenkel unterschenkel schenkel knie fuss zeh zehe zehen huf "
        "pfote jambe cuisse mollet genou pied orteil patte sabot cheville pierna muslo rodilla pie pata "
        "pantorrilla tobillo gamba gambe coscia ginocchio piede zampa zoccolo caviglia perna coxa joelho pe "
        "casco tornozelo noga nogi udo kolano stopa lapa ashi hiza momo dij onderbeen bovenbeen voet poot "
        "ben bacak ayak noha koleno ",
        "足 脚 腿 膝 ひざ つま先 もも 다리 발목 ног бедр голен стоп колен лап "},
    {SBFI_WORD_ARM,
        " arm arms forearm upperarm hand hands elbow shoulder clavicle wrist finger thumb pinky oberarm "
        "unterarm schulter ellbogen finger daumen bras main coude epaule doigt brazo mano codo hombro dedo "
        "braccio gomito spalla dito braco mao cotovelo ombro ramie reka dlon lokiec ude te ",
        "腕 肩 肘 手 팔 рук плеч локт кист "},
    {SBFI_WORD_FIN,
        " fin fins flipper flippers fluke flukes pectoral dorsal caudal gill gills flosse flossen nageoire "
        "nageoires aleta aletas pinna pinne barbatana nadadeira pletwa pletwy hire ",
        "鰭 鳍 ひれ ヒレ 지느러미 плавник "},
    {SBFI_WORD_WING,
        " wing wings winglet feather feathers flap elytra patagium fluegel flugel schwinge schwingen feder "
        "federn aile ailes plume plumes ala alas ali pluma asa asas skrzydlo skrzydla rotor rotors propeller "
        "prop vleugel ",
        "翼 羽 翅 つばさ ハネ 날개 крыл "},
    {SBFI_WORD_WHEEL,
        " wheel wheels tire tires tyre tyres rim rims axle axles tread treads track tracks sprocket caster "
        "rad raeder reifen felge achse kette ketten roue roues pneu pneus essieu chenille rueda ruedas "
        "llanta eje ruota ruote cingolo cingoli gomma roda rodas eixo kolo kola opona wiel ",
        "車輪 タイヤ ホイール 轮 輪 바퀴 колес гусениц "},
    {SBFI_WORD_SNAKE,
        " snake snakes serpent viper cobra python rattlesnake anaconda worm schlange wurm serpiente culebra "
        "serpente couleuvre verme waz slang hebi ",
        "蛇 ヘビ へび 뱀 зме "},
    {SBFI_WORD_SPINE,
        " spine spine1 chest pelvis hips hip torso abdomen neck vertebra wirbel ruecken brust becken hals "
        "rumpf rueckgrat colonne dos bassin cou poitrine columna pecho cadera cuello schiena petto bacino "
        "collo coluna peito quadril pescoco kregoslup klatka biodra szyja thorax ",
        "背 脊 胸 腰 首 спин груд таз ше "},
    {SBFI_WORD_TAIL, " tail tails schwanz schweif queue cola rabo coda cauda ogon shippo staart ",
        "尾 しっぽ 꼬리 хвост "},
    {SBFI_WORD_HEAD,
        " head kopf tete cabeza testa cabeca glowa atama hoofd skull jaw snout nose mouth eye eyes kiefer "
        "schnauze auge augen maul ",
        "頭 头 머리 голов "},
    {SBFI_WORD_MOUTH,
        " tongue mouth jaw lip lips teeth tooth fang fangs zunge maul kiefer lippe langue bouche machoire "
        "lengua boca lingua bocca mascella jezyk usta szczeka ",
        "舌 口 顎 혀 язык челюст "},
    {SBFI_WORD_FISH,
        " fish shark whale dolphin orca ray stingray manta eel tuna trout salmon koi goldfish carp squid "
        "octopus jellyfish seahorse seal narwhal barracuda piranha swordfish pike fisch hai wal delfin "
        "rochen aal lachs poisson requin baleine dauphin raie anguille pez tiburon ballena delfines raya "
        "pesce squalo balena delfino peixe tubarao baleia golfinho ryba rekin wieloryb submarine tadpole ",
        "魚 鱼 サメ 鯨 물고기 рыб акул кит дельфин "},
    {SBFI_WORD_BIRD,
        " bird eagle hawk falcon owl crow raven pigeon dove gull seagull parrot sparrow duck goose swan bat "
        "bee wasp hornet fly mosquito butterfly moth dragonfly pterodactyl pteranodon drone quadcopter "
        "helicopter plane airplane aircraft jet ufo ghost wyvern phoenix vogel adler eule krahe taube biene "
        "wespe schmetterling fledermaus oiseau aigle hibou abeille guepe papillon pajaro aguila buho abeja "
        "avispa mariposa murcielago uccello aquila gufo ape vespa farfalla pipistrello passaro aguia abelha "
        "borboleta morcego ptak orzel sowa pszczola osa motyl ",
        "鳥 鸟 蝶 蜂 새 птиц орел бабоч пчел "},
    {SBFI_WORD_VEHICLE,
        " car cars truck tank bus van taxi jeep tractor kart buggy vehicle motorcycle motorbike bicycle bike "
        "trolley wagon cart tram rover lorry auto lkw panzer fahrrad voiture camion char velo coche "
        "tractor moto bicicleta macchina carro carrello caminhao samochod ciezarowka rower ",
        "車 车 자동차 машин танк автомобил "},
    {SBFI_WORD_WALKER,
        " human man woman person people horse dog cat cow wolf fox bear deer sheep goat pig lion tiger "
        "elephant lizard spider crab ant beetle robot zombie knight soldier skeleton dinosaur trex raptor "
        "mensch pferd hund katze kuh ",
        NULL},
    {SBFI_WORD_OBJECT,
        " lever door gate crate box barrel coin key trap spike spikes button lid hinge drawer cannon flag "
        "platform hazard plant tree chain rope lamp treasure truhe tuer hebel kiste porte coffre levier "
        "puerta cofre palanca porta baule leva bau alavanca skrzynia drzwi ",
        NULL},
};

/* Pieces that end in a listed word by chance. */
static const char *const accidents =
    " swing owing drawing rowing arrowing following growing throwing showing knowing viewing sewing wingding "
    "barrel charm alarm farm harm swarm warm coffin muffin dolphin griffin paraffin define "
    "begleg blimp grim trim prim scrim pilgrim brim crim attached subtract crease contract extract nutrack "
    "dachs soundtrack backtrack racetrack grade retire entire attire satire empire "
    "nipple strap wrap scrap fahrrad aimprop shoulderpad ";

static bool is_listed(const char *list, const char *piece, size_t length) {
  for (const char *at = list; (at = strstr(at, piece)) != NULL; at++)
    if (at != list && at[-1] == ' ' && at[length] == ' ') return true;
  return false;
}

/* Whether a piece ends in a listed word. Excludes short words, because too many other words end in them. */
static bool ends_listed(const char *list, const char *piece, size_t length) {
  static const char *const shorts = " leg toe fin arm paw hip ";
  for (size_t skip = 1; skip + MIN_SUFFIX <= length; skip++) {
    size_t left = length - skip;
    if (!is_listed(list, piece + skip, left) || is_listed(accidents, piece, length)) continue;
    if (left > MIN_SUFFIX || is_listed(shorts, piece + skip, left)) return true;
  }
  return false;
}

static bool is_inside(const char *list, const char *name) {
  char word[64];
  while (list && *list) {
    const char *end = strchr(list, ' ');
    size_t length = end ? (size_t)(end - list) : strlen(list);
    if (length && length < sizeof word) {
      memcpy(word, list, length);
      word[length] = 0;
      if (strstr(name, word)) return true;
    }
    list += length + (end != NULL);
  }
  return false;
}

/* Splits a name into lower case pieces with spaces around each. Replaces letters with diacritics by plain
 * ones. */
static void split_name(const char *name, char *pieces, size_t size) {
  static const char *const plain[][2] = {{"ä", "ae"}, {"ö", "oe"}, {"ü", "ue"}, {"ß", "ss"}, {"é", "e"},
      {"è", "e"}, {"ê", "e"}, {"á", "a"}, {"à", "a"}, {"â", "a"}, {"ã", "a"}, {"ç", "c"}, {"ñ", "n"},
      {"í", "i"}, {"ó", "o"}, {"ô", "o"}, {"ú", "u"}, {"ł", "l"}, {"ą", "a"}, {"ę", "e"}, {"ó", "o"},
      {"ż", "z"}, {"ź", "z"}, {"ś", "s"}, {"ć", "c"}, {"ń", "n"}, {"Ä", "ae"}, {"Ö", "oe"}, {"Ü", "ue"},
      {"É", "e"}, {"Ł", "l"}, {"õ", "o"}};
  size_t used = 0;
  pieces[used++] = ' ';
  for (const char *at = name; *at && used + 4 < size;) {
    bool replaced = false;
    for (size_t i = 0; i < sizeof plain / sizeof *plain && !replaced; i++) {
      size_t length = strlen(plain[i][0]);
      if (strncmp(at, plain[i][0], length) != 0) continue;
      for (const char *k = plain[i][1]; *k; k++) pieces[used++] = *k;
      at += length;
      replaced = true;
    }
    if (replaced) continue;
    unsigned char c = (unsigned char)*at;
    bool begins =
        isupper(c) && at != name &&
        (islower((unsigned char)at[-1]) || (isupper((unsigned char)at[-1]) && islower((unsigned char)at[1])));
    if ((begins || !isalpha(c)) && pieces[used - 1] != ' ') pieces[used++] = ' ';
    if (isalpha(c)) pieces[used++] = (char)tolower(c);
    at++;
  }
  if (pieces[used - 1] != ' ') pieces[used++] = ' ';
  pieces[used] = 0;
}

/* Tests the pieces of a name until one matches. */
static bool any_piece(const char *pieces, const char *list, bool ends) {
  char piece[LONGEST_NAME];
  for (const char *at = pieces + 1; *at;) {
    size_t length = strcspn(at, " ");
    memcpy(piece, at, length);
    piece[length] = 0;
    if (is_listed(list, piece, length) || (ends && ends_listed(list, piece, length))) return true;
    at += length + (at[length] == ' ');
  }
  return false;
}

uint32_t sbfi_words_of(const char *name) {
  char pieces[LONGEST_NAME];
  uint32_t words = 0;
  split_name(name, pieces, sizeof pieces);
  for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
    /* Names of animals are too short and numerous to match the ends of other words. */
    bool ends = lists[i].word <= SBFI_WORD_SPINE || lists[i].word == SBFI_WORD_TAIL;
    if (any_piece(pieces, lists[i].pieces, ends) || is_inside(lists[i].inside, name))
      words |= 1u << lists[i].word;
  }
  return words;
}

/* --- Clips ------------------------------------------------------------------------------------------- */

typedef struct clip_list {
  sbfi_locomotion_kind kind;
  const char *pieces, *inside;
} clip_list;

static const clip_list clip_lists[] = {
    {SBFI_LOCOMOTION_SWIM,
        " swim swimming swims schwimmen nager nage nadar nado nuotare nuoto plywanie plywa tread zwemmen ",
        "泳 плыв плав "},
    {SBFI_LOCOMOTION_FLY,
        " takeoff fly flying flies flight hover hovering glide gliding flap flapping soar fliegen flug "
        "gleiten voler "
        "vol planer volar vuelo volare volo planare voar latanie lot vliegen ",
        "飛 飞 лет "},
    {SBFI_LOCOMOTION_SLITHER, " slither slithering kriechen schlaengeln ramper strisciare ", NULL},
    {SBFI_LOCOMOTION_WALK,
        " walk walking walks walkcycle run running runs gallop galloping trot trotting jog jogging sprint "
        "sneak canter laufen gehen lauf gang galopp schleichen marcher marche courir course caminar correr "
        "andar camminare camminata corsa corre chod bieg biegac lopen rennen strafe ",
        "歩 走 步 跑 ход бег "},
    {SBFI_LOCOMOTION_ROLL,
        " drive driving drives forward forwards backward backwards turning fahren conduire rouler conducir "
        "guidare dirigir jechac rijden reverse ",
        "走行 "},
    {SBFI_LOCOMOTION_NONE,
        " open opening close closing on off bounce activate deactivate rotate spin oeffnen schliessen ouvrir "
        "fermer abrir cerrar aprire chiudere otworz ",
        NULL},
};

sbfi_locomotion_kind sbfi_clip_kind(const char *name) {
  char pieces[LONGEST_NAME];
  split_name(name, pieces, sizeof pieces);
  /* A dodge, a roll or a jump forward is not locomotion. */
  bool dodge = any_piece(pieces, " dodge roll jump leap hit death kick attack punch fall dash ", false);
  for (size_t i = 0; i < sizeof clip_lists / sizeof *clip_lists; i++) {
    const clip_list *list = &clip_lists[i];
    if (dodge && (list->kind == SBFI_LOCOMOTION_ROLL || list->kind == SBFI_LOCOMOTION_NONE)) continue;
    if (any_piece(pieces, list->pieces, false)) return list->kind;
  }
  for (size_t i = 0; i < sizeof clip_lists / sizeof *clip_lists; i++)
    if (is_inside(clip_lists[i].inside, name)) return clip_lists[i].kind;
  return SBFI_LOCOMOTION_KINDS;
}

bool sbfi_clip_is_idle(const char *name) {
  char pieces[LONGEST_NAME];
  split_name(name, pieces, sizeof pieces);
  if (any_piece(pieces,
          " gun sword jump lie lying hit react shoot attack weapon rifle pistol sit sitting death dead fall "
          "sleep crouch duck hold holding aim hanging swim low headlow eating fight combat shield bow air ",
          true))
    return false;
  return any_piece(
      pieces, " idle idling stand standing rest breathe breathing stehen reposo ruhe repos ", true);
}
