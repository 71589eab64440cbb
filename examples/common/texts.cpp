// Templates: {p} the place, {n} a number of 2..59, {e} the event's tag. The first post is a morning's, the sixth a
// night's.
#include "common/texts.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <string>

namespace demo {
namespace {

struct Language {
    std::string_view countries; // where it is written, two letters each
    std::string_view posts[7];
    std::string_view event_posts[3];
};

constexpr size_t morning = 0;
constexpr size_t night = 5;

constexpr std::string_view kind_names[event_kinds] = {"concert", "finale",   "earthquake",
                                                      "storm",   "festival", "blackout"};

// The first one serves where no other is at home.
constexpr Language languages[] = {
    {"USGBAUCANZIEZANGKEGH",
     {"Good morning from {p} ☀", "{n} minutes late again. Thank you, {p} traffic", "Best coffee in {p}, hands down",
      "Anyone up for a run along the river in {p}?", "Rain, sun, rain. Typical {p}", "Home at last. Night, {p}",
      "New exhibition in {p} is worth the queue ({n} min)"},
     {"#{e} in {p}, unbelievable!", "Is everyone seeing this? #{e} {p}", "{p} right now: #{e}"}},
    {"DEATCH",
     {"Guten Morgen aus {p}!", "Schon wieder {n} Minuten Verspätung in {p}", "Sonne über {p}, endlich",
      "Wochenmarkt in {p}: großartig", "Wer kennt ein gutes Café in {p}?", "Feierabend in {p} 🍺",
      "Stau vor {p}, {n} km"},
     {"#{e} in {p}, unglaublich!", "Was ist denn da los in {p}? #{e}", "{p} gerade jetzt: #{e}"}},
    {"FRBELUSNCIMG",
     {"Bonjour de {p} !", "Encore {n} minutes de retard à {p}", "Le marché de {p} ce matin, un régal",
      "Il pleut sur {p}", "Un café en terrasse à {p} ☕", "Bonne nuit {p}", "Quelqu'un connaît un bon resto à {p} ?"},
     {"#{e} à {p}, incroyable !", "Vous avez vu ça ? #{e} {p}", "{p} en ce moment : #{e}"}},
    {"ESMXARCOCLPEVEECBOPYUYGTCUDOHNSVNICRPA",
     {"¡Buenos días desde {p}!", "{n} minutos esperando el autobús en {p}", "Tarde de sol en {p} ☀",
      "El mejor café está en {p}", "¿Alguien para correr por {p}?", "Buenas noches, {p}", "Qué lluvia en {p}"},
     {"¡#{e} en {p}, increíble!", "¿Lo están viendo? #{e} {p}", "{p} ahora mismo: #{e}"}},
    {"BRPTAOMZ",
     {"Bom dia, {p}!", "{n} minutos parado no trânsito de {p}", "Que pôr do sol em {p} 🌅",
      "Café e pão de queijo em {p}", "Chuva de novo em {p}", "Boa noite, {p}",
      "Alguém indica um bom restaurante em {p}?"},
     {"#{e} em {p}, inacreditável!", "Vocês estão vendo isso? #{e} {p}", "{p} agora: #{e}"}},
    {"ITSM",
     {"Buongiorno da {p}!", "Treno in ritardo di {n} minuti a {p}", "Che sole oggi a {p}",
      "Il miglior gelato è a {p} 🍦", "Piove su {p}", "Buonanotte {p}", "Passeggiata serale per {p}"},
     {"#{e} a {p}, incredibile!", "Lo vedete anche voi? #{e} {p}", "{p} in questo momento: #{e}"}},
    {"TR",
     {"Günaydın {p}!", "{p} trafiğinde {n} dakika", "Bugün {p} çok güzel ☀", "{p} sahilinde çay keyfi",
      "Yağmur başladı {p}", "İyi geceler {p}", "{p} için yemek önerisi olan var mı?"},
     {"{p} #{e}, inanılmaz!", "Bunu gören var mı? #{e} {p}", "Şu anda {p}: #{e}"}},
    {"RUBYKZKG",
     {"Доброе утро, {p}!", "{p}: пробка на {n} минут", "Солнце над {p} ☀", "Лучший кофе в городе {p}",
      "Снова дождь, {p}", "Спокойной ночи, {p}", "Гуляем по {p}, красота"},
     {"#{e} {p}, невероятно!", "Вы это видите? #{e} {p}", "{p} прямо сейчас: #{e}"}},
    {"IDMY",
     {"Selamat pagi {p}!", "Macet {n} menit di {p}", "Kopi enak di {p} ☕", "Hujan lagi di {p}",
      "Sore yang indah di {p}", "Selamat malam {p}", "Ada rekomendasi makan di {p}?"},
     {"#{e} di {p}, luar biasa!", "Kalian lihat ini? #{e} {p}", "{p} sekarang: #{e}"}},
    {"INNPLK",
     {"सुप्रभात {p}!", "{p} traffic: {n} minutes for one km", "{p} में बारिश 🌧", "Best chai in {p} ☕",
      "{p} की शाम सुहानी है", "Good night {p}", "Cricket practice in {p} at {n} past six"},
     {"#{e} in {p}, unbelievable!", "{p} में अभी: #{e}", "Is everyone seeing this? #{e} {p}"}},
    {"CNTWHKSG",
     {"早安 {p}!", "{p} 堵车 {n} 分钟", "{p} 今天天气真好 ☀", "{p} 的夜景太美了", "又下雨了 {p}", "晚安 {p}",
      "{p} 有什么好吃的?"},
     {"{p} #{e} 太不可思议了!", "你们看到了吗? #{e} {p}", "{p} 现在: #{e}"}},
    {"JP",
     {"おはよう {p}!", "{p} の電車が {n} 分遅れ", "{p} は今日もいい天気 ☀", "{p} でラーメン 🍜", "雨の {p}",
      "おやすみ {p}", "{p} の夕焼けがきれい"},
     {"{p} で #{e} すごい!", "みんな見てる? #{e} {p}", "{p} いま: #{e}"}},
    {"KR",
     {"좋은 아침 {p}!", "{p} 길이 {n} 분째 막혀요", "오늘 {p} 날씨 최고 ☀", "{p} 커피 맛집 ☕", "{p} 에 비가 와요",
      "잘 자요 {p}", "{p} 야경이 예뻐요"},
     {"{p} #{e} 대박!", "다들 보고 있어요? #{e} {p}", "지금 {p}: #{e}"}},
    {"EGSAIQSYJOAEYELBLYSDDZMATNKWOMQA",
     {"صباح الخير {p}!", "زحمة في {p} منذ {n} دقيقة", "قهوة الصباح في {p} ☕", "مطر في {p} 🌧",
      "مساء جميل في {p}", "تصبحون على خير {p}", "أحسن مطعم في {p}؟"},
     {"#{e} في {p}!", "هل ترون هذا؟ #{e} {p}", "{p} الآن: #{e}"}},
};

const Language &language_of(std::string_view country) {
    for (const Language &language : languages)
        for (size_t i = 0; i + 1 < language.countries.size(); i += 2)
            if (language.countries.substr(i, 2) == country)
                return language;
    return languages[0];
}

// Appends to a text of limited size.
class Writer {
public:
    Writer(char *text, size_t size) : text_(text), size_(size) {}
    ~Writer() { std::fill(text_ + used_, text_ + size_, '\0'); }
    Writer(const Writer &) = delete;
    Writer &operator=(const Writer &) = delete;

    void add(std::string_view part) {
        if (full_)
            return;
        size_t count = std::min(part.size(), size_ - used_);
        full_ = count < part.size();
        while (full_ && count > 0 && (part[count] & 0xc0) == 0x80)
            --count; // whole characters only
        std::copy_n(part.begin(), count, text_ + used_);
        used_ += count;
    }

private:
    char *text_;
    size_t size_;
    size_t used_ = 0;
    bool full_ = false;
};

void fill(char *text, size_t size, std::string_view pattern, std::string_view place, std::string_view tag,
          Random &random) {
    Writer writer(text, size);
    for (size_t brace; (brace = pattern.find('{')) != std::string_view::npos; pattern.remove_prefix(brace + 3)) {
        writer.add(pattern.substr(0, brace));
        const char what = pattern[brace + 1];
        if (what == 'n')
            writer.add(std::to_string(2 + random.below(58)));
        else
            writer.add(what == 'p' ? place : tag);
    }
    writer.add(pattern);
}

} // namespace

std::string_view event_kind_name(size_t kind) { return kind_names[kind]; }

void write_post(char *text, size_t size, std::string_view country, std::string_view place, int hour, Random &random) {
    const std::span posts(language_of(country).posts);
    const auto fits = [hour](size_t i) {
        return i == morning ? hour >= 5 && hour < 11 : i == night ? hour >= 20 || hour < 4 : true;
    };
    size_t chosen = random.below(posts.size());
    while (!fits(chosen))
        chosen = random.below(posts.size());
    fill(text, size, posts[chosen], place, "", random);
}

void write_event_post(char *text, size_t size, std::string_view country, std::string_view place, size_t kind,
                      Random &random) {
    const std::span posts(language_of(country).event_posts);
    fill(text, size, posts[random.below(posts.size())], place, event_kind_name(kind), random);
}

} // namespace demo
